// The verb film.
#pragma once

#include "app/context.hpp"

namespace scanbench::app {

void add_film(Context& context);

}  // namespace scanbench::app
