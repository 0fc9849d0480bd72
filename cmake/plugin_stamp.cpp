// The stamp of a shared library of modules, compiled into it with its own flags.
#include "core/plugin_stamp.hpp"

extern "C" __attribute__((used, visibility("default"))) const char scanbench_plugin_stamp[] = SCANBENCH_PLUGIN_STAMP;
