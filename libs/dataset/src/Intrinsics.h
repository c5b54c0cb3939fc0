// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "PngImage.h"
#include "hoctomap/dataset/Dataset.h"

namespace hoctomap {

/// Intrinsics by the name of a camera of the TUM benchmark; nothing if it is none.
[[nodiscard]] std::optional<Intrinsics> namedCamera(const std::string& name);

/// @throws InputError unless the focal lengths are positive
void checkIntrinsics(const Intrinsics& k);

/// The pinhole camera of an image. @throws InputError if the principal point lies outside of it.
[[nodiscard]] PinholeCamera cameraFor(const Intrinsics& k, int width, int height);

/// Depths in metres; 0 and `no_return` become 0. @param unit metres a step
[[nodiscard]] DepthImage depthImage(const RawDepth& raw, const Intrinsics& k, double unit,
                                    std::uint16_t no_return);

/// Turns the sensor frame (x forward, y left, z up) into the optical frame (x right, y down, z forward).
[[nodiscard]] Pose opticalTSensor();

/// "585 585 320 240"
[[nodiscard]] std::string textOf(const Intrinsics& k);

/// The `InputError`s and `LimitError`s of `make` get `place: ` before their text.
template <class Make>
auto placed(const std::string& place, const Make& make) {
  try {
    return make();
  } catch (const InputError& what) {
    throw InputError(place + ": " + what.what());
  } catch (const LimitError& what) {
    throw LimitError(place + ": " + what.what());
  }
}

}  // namespace hoctomap
