// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hoctomap {

/// Whether two sets of points show the same object.
enum class Match { same, different, ambiguous };

/// What a scan says of a place.
enum class Sight {
  surface,      ///< something is there
  hidden,       ///< out of view, without a return, or behind something
  seen_through  ///< the beam went on
};

struct RegistrationConfig {
  double spacing = 0.004;   ///< m between the points that are compared
  double near = 0.006;      ///< m, within which two surfaces overlap (grows with the noise: `tolerance`)
  double tolerance = 0.0;   ///< m, added to `near` and `max_rms`: noise and voxels of the two sets
  double max_rms = 0.0035;  ///< m, of the overlapping points of one object
  double max_height_error = 0.012;  ///< m, between the tops of the two
  double same_overlap = 0.85;       ///< both ways
  double different_overlap = 0.6;   ///< of `seen` in `model`; below it they differ
  double least_overlap = 0.45;      ///< of either in the other; below it they differ
  double least_explained = 0.5;     ///< share of all seen points near the model, new sides or not
  double max_seen_through = 0.12;   ///< share of the model that the scan may contradict
  double min_visible = 0.25;        ///< share of the model that the scan must show
  double rival_score = 0.03;        ///< a pose within it is as good: the smaller turn is kept
  double at_rest = 0.9;             ///< a model that fits this well where it is has not moved
  int yaw_starts = 18;              ///< turns about the vertical that are tried
};

struct Registration {
  Match verdict = Match::different;
  /// World motion that takes `model` onto `seen`: p_after = motion * p_before.
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  double overlap_model = 0.0;  ///< share of the model's visible points near a seen point
  double overlap_seen = 0.0;   ///< share of the seen points that the model can show near one of its points
  double explained = 0.0;      ///< share of all seen points near a point of the model
  double rms = 0.0;            ///< m, of the overlapping points
  double outline_error = 0.0;  ///< m, root mean square distance of the edges that meet; 0 if none do
  double seen_through = 0.0;   ///< share of the model's points that the scan contradicts
  double rest_score = 0.0;     ///< the score without any motion
  double score = 0.0;          ///< the smaller of the two overlaps
  /// rad about the vertical, to be added to that of `motion`: turns that fit as well. What is nearly square
  /// may have made a quarter turn, what is round any.
  std::vector<double> other_turns;
};

/// What a registration may ask of the world beside the two sets of points. All are optional.
struct RegistrationSight {
  /// What the scan says of a place; none: everything is visible.
  std::function<Sight(const Eigen::Vector3f&)> now = nullptr;
  /// Where the scan was taken from, and whether earlier beams passed a place beside the model. Both tell
  /// which way surfaces face: a turned object shows sides that nobody has seen before. None: it shows no new
  /// ones.
  std::optional<Eigen::Vector3d> origin = std::nullopt;
  std::function<bool(const Eigen::Vector3f&)> was_free = nullptr;
  double beside = 0.06;
  /// Whether earlier scans would have shown a surface at a place: then the model ends there, and not only
  /// what was seen of it. None: always.
  std::function<bool(const Eigen::Vector3f&)> was_shown = nullptr;
};

/// Registers the points of a known object to points that may show it elsewhere (III-D): turns about the
/// vertical about aligned centroids, trimmed iterated closest points (Chetverikov et al. 2002), the best of
/// them refined, in six degrees of freedom if that fits better. Points of the model that the scan cannot show
/// at the new place do not count, nor do seen points of sides that the model does not have.
/// @param model_world  surface points of the object where it was, m
/// @param seen_world   points that the scan shows, m
/// @param sight        places in the world, m
[[nodiscard]] Registration registerPoints(std::span<const Eigen::Vector3f> model_world,
                                          std::span<const Eigen::Vector3f> seen_world,
                                          const RegistrationConfig& config,
                                          const RegistrationSight& sight = {});

}  // namespace hoctomap
