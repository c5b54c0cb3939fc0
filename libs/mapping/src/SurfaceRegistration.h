// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ClosestPoints.h"

namespace hoctomap {

/// `registerPoints` for surfaces that are registered several times.
[[nodiscard]] Registration registerSurfaces(const RegistrationSurface& model, const RegistrationSurface& seen,
                                            const RegistrationConfig& config, const RegistrationSight& sight);

}  // namespace hoctomap
