// What temperatures fit a retarget problem.

#pragma once

#include "anneal/temperature.h"
#include "retarget/anneal_instance.h"

namespace bn::retarget {

/// Temperatures found from the instance, which must outlive the result.
anneal::TemperatureSource temperature_source(const AnnealInstance& instance);

}  // namespace bn::retarget
