// Puts the verbs into drawers.
#include "app/drawers.hpp"

#include "app/authoring/conform.hpp"
#include "app/authoring/new_module.hpp"
#include "app/verbs/compare.hpp"
#include "app/verbs/figures.hpp"
#include "app/verbs/film.hpp"
#include "app/verbs/inspection.hpp"
#include "app/verbs/night.hpp"
#include "app/verbs/recordings.hpp"
#include "app/verbs/results.hpp"
#include "app/verbs/run.hpp"
#include "app/verbs/shell_help.hpp"
#include "app/verbs/show.hpp"
#include "app/verbs/sweep.hpp"

namespace scanbench::app {
namespace {

void add_module(CommandLine& line) {
  Verb module = line.add_verb("module", "Modules of your own: new, conform");
  add_new_module(module);
  add_conform(module);
}

void add_former_names(CommandLine& line) {
  for (const char* verb : {"plan", "status", "merge", "submit", "unpack"})
    line.renamed(verb, std::string("sweep ") + verb);
  line.renamed("nightly", "night run");
  line.renamed("accept", "night accept");
  line.renamed("store", "night store");
  line.renamed("new", "module new");
  line.renamed("conform", "module conform");
}

}  // namespace

void add_drawers(CommandLine& line) {
  line.drawer("Run scenarios");
  add_run(line);
  add_check(line);
  add_simulate(line);
  add_export(line);
  line.drawer("Look at results");
  add_report(line);
  add_figures(line);
  add_film(line);
  add_show(line);
  add_compare(line);
  add_score(line);
  line.drawer("Every night, on many machines");
  add_night(line);
  add_sweep(line);
  line.drawer("Modules, and whatever else has a name");
  add_list(line);
  add_describe(line);
  add_module(line);
  line.drawer("This program");
  add_shell_help(line);
  add_former_names(line);
}

}  // namespace scanbench::app
