// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "ClosestPoints.h"

namespace hoctomap {

/// Turns the normals of the known object, and of what is seen, to where they are seen from, as far as that is
/// known.
void orientModel(RegistrationSurface& model, const RegistrationSight& sight);
void orientSeen(RegistrationSurface& seen, const RegistrationSight& sight);

/// The score that a motion must reach to be of use, given that without any.
using LeastScore = std::function<double(double rest_score)>;

/// `registerPoints` for surfaces that are registered several times. A motion that is far from `least_score`
/// once it is near its end is not followed further: the two are `different`.
[[nodiscard]] Registration registerSurfaces(const RegistrationSurface& model, const RegistrationSurface& seen,
                                            const RegistrationConfig& config, const RegistrationSight& sight,
                                            const LeastScore& least_score = {});

}  // namespace hoctomap
