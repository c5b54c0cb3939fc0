// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ClosestPoints.h"

namespace hoctomap {

/// Turns the normals of the known object, and of what is seen, to where they are seen from, as far as that is
/// known.
void orientModel(RegistrationSurface& model, const RegistrationSight& sight);
void orientSeen(RegistrationSurface& seen, const RegistrationSight& sight);

/// `registerPoints` for surfaces that are registered several times.
[[nodiscard]] Registration registerSurfaces(const RegistrationSurface& model, const RegistrationSurface& seen,
                                            const RegistrationConfig& config, const RegistrationSight& sight);

}  // namespace hoctomap
