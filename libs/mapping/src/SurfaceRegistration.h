// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "ClosestPoints.h"

namespace hoctomap {

/// Turns the normals of the known object, and of what is seen, to where they are seen from, as far as that is
/// known.
void orientModel(RegistrationSurface& model, const RegistrationSight& sight);
void orientSeen(RegistrationSurface& seen, const RegistrationSight& sight);

/// The score that a motion must reach to be of use, given how the two fit without any; nothing: none is.
using MotionNeeds = std::function<std::optional<double>(const Registration& rest)>;

/// `registerPoints` for surfaces that are registered several times. A motion that is far from what it needs
/// once it is near its end is not followed further: the two are `different`.
[[nodiscard]] Registration registerSurfaces(const RegistrationSurface& model, const RegistrationSurface& seen,
                                            const RegistrationConfig& config, const RegistrationSight& sight,
                                            const MotionNeeds& needs = {});

}  // namespace hoctomap
