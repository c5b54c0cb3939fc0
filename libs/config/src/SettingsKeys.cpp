// SPDX-License-Identifier: BSD-3-Clause
// The table of keys: add a setting here and in docs/configuration.md, nowhere else.
#include "SettingsKeys.h"

#include <array>

namespace hoctomap::keys {
namespace {

template <class>
struct OwnerOf;
template <class Member, class Owner>
struct OwnerOf<Member Owner::*> {
  using type = Owner;
};

// The member that a chain of pointers to members leads to.
template <auto First, auto... Rest>
auto& at(typename OwnerOf<decltype(First)>::type& owner) {
  return ((owner.*First).*....*Rest);
}

// Shorter names for the rows below.
using S = Settings;
using T = TabletopSegmentationConfig;
using E = BeamExistenceConfig;
using L = Limits;
using P = LabelProfile;
using O = OccupancyModel;
using X = ExistenceParameters;
using R = LabelRule;
using A = ExplorationConfig;
using V = ViewpointConfig;
using G = GainConfig;

constexpr Range any{};
constexpr Range share{0.0, 1.0};
constexpr Range probability_range{0.0, 1.0, true, true};
constexpr Range below_half{0.0, 0.5, true, true};
constexpr Range above_half{0.5, 1.0, true, true};
constexpr Range count{1.0, 1e6};
constexpr Range big_count{1.0, 1e15};

constexpr Range above(double min) {
  return {min, Range{}.max, true, false};
}
constexpr Range within(double min, double max) {
  return {min, max};
}
constexpr Range aboveUpTo(double min, double max) {
  return {min, max, true, false};
}

constexpr auto settings_keys = std::to_array<Key<Settings>>({
    {"mapping", "monolithic", "", any,
     "One map of the root alone, no segmentation, beams unbounded: what stock OctoMap builds "
     "(`--monolithic`)",
     &at<&S::monolithic>},
    {"mapping", "association_margin", "m", within(0, 1),
     "The box of a segment is grown by this much on every side before it is compared with the boxes of nodes",
     &at<&S::association_margin>},
    {"mapping",
     "contest_at_surface",
     "",
     {},
     "Of several segments of a scan whose boxes meet that of one node, only those at its surface join it",
     &at<&S::contest_at_surface>},
    {"mapping", "seam_votes", "", any,
     "What a node is goes by surfaces and by the votes of all scans on where objects meet: segments that "
     "bridge "
     "nodes are divided, nodes are split and merged",
     &at<&S::seam_votes>},
    {"mapping",
     "reidentify",
     "",
     {},
     "An object that lost its place and a new segment of the same shape are one object that was moved",
     &at<&S::reidentify>},
    {"mapping", "confirm_scans", "scans", count,
     "Scans that must show an object before its node enters the map; until then it is held back, with all "
     "that is "
     "measured of it",
     &at<&S::confirm_scans>},
    {"mapping", "checkpoint_scans", "scans", count,
     "The map is committed to disk after every so many scans; a killed run loses no more",
     &at<&S::checkpoint_scans>},

    {"poses", "max_gap", "s", within(0, 3600),
     "Largest time between two poses of the log that is interpolated over; scans in longer gaps are skipped",
     &at<&S::poses, &PosesConfig::max_gap>},

    {"sensor", "min_range", "m", within(0, 1e4), "Points nearer than this are dropped",
     &at<&S::sensor, &SensorConfig::min_range>},
    {"sensor", "max_range", "m", above(0),
     "A beam that is longer clears space up to this range and marks nothing; a label may lower it",
     &at<&S::sensor, &SensorConfig::max_range>, true},
    {"sensor", "noise_constant", "m", within(0, 1),
     "Noise of a range z: sigma = noise_constant + noise_quadratic z^2",
     &at<&S::existence, &E::noise, &RangeNoise::constant>},
    {"sensor", "noise_quadratic", "1/m", within(0, 1), "See `noise_constant`",
     &at<&S::existence, &E::noise, &RangeNoise::quadratic>},

    {"segmentation", "method", "", any, "How the objects on a table are told apart (Section IV-A)",
     &at<&S::tabletop, &T::method>},
    {"segmentation", "table_height_min", "m", within(-1000, 1000),
     "Lowest height of a table: z of its centre in the world frame", &at<&S::tabletop, &T::table_height_min>},
    {"segmentation", "table_height_max", "m", within(-1000, 1000), "Largest height of a table",
     &at<&S::tabletop, &T::table_height_max>},
    {"segmentation", "plane_tolerance", "m", aboveUpTo(0, 1),
     "What a table may depart from its plane; the noise of the range is added",
     &at<&S::tabletop, &T::plane_tolerance>},
    {"segmentation", "plane_max_tilt", "degrees", within(0, 45),
     "Largest angle between the normal of a table and the vertical", &at<&S::tabletop, &T::plane_max_tilt>},
    {"segmentation", "min_table_area", "m^2", aboveUpTo(0, 100), "Planes of which less is seen are no tables",
     &at<&S::tabletop, &T::min_table_area>},
    {"segmentation", "outline_cell", "m", within(0.001, 1), "Cell of the outline of a table",
     &at<&S::tabletop, &T::outline_cell>},
    {"segmentation", "ransac_draws", "", count, "Draws of the random search for one plane",
     &at<&S::tabletop, &T::ransac_draws>},
    {"segmentation", "seed", "", within(0, 4294967295.0),
     "Seed of the random draws: the same seed gives the same map", &at<&S::tabletop, &T::seed>},
    {"segmentation", "cluster_tolerance", "m", aboveUpTo(0, 1),
     "Points above a table that are nearer to each other than this belong to one object",
     &at<&S::tabletop, &T::cluster_tolerance>},
    {"segmentation", "object_height_max", "m", aboveUpTo(0, 10),
     "Height above the table; what reaches higher is background", &at<&S::tabletop, &T::object_height_max>},
    {"segmentation", "object_size_max", "m", aboveUpTo(0, 100),
     "Horizontal extent; what is wider is background", &at<&S::tabletop, &T::object_size_max>},
    {"segmentation", "min_object_height", "m", within(0, 10),
     "What rises less above the table around it is a part of the table. Up to 0.025 m only things with a "
     "step at their rim are believed (`convex_patches`) or none (`euclidean`)",
     &at<&S::tabletop, &T::min_object_height>},
    {"segmentation", "min_object_size", "m", within(0, 10),
     "Clusters whose largest extent is smaller are background", &at<&S::tabletop, &T::min_object_size>},
    {"segmentation", "min_cluster_points", "points", count, "Clusters of fewer points are background",
     &at<&S::tabletop, &T::min_cluster_points>},
    {"segmentation", "object_noise_max", "m", aboveUpTo(0, 10),
     "Where 3 sigma of the range is more, objects are not told apart",
     &at<&S::tabletop, &T::object_noise_max>},
    {"segmentation", "contact_height", "m", within(0, 10),
     "Height above the table at which an object must begin; what begins higher is background",
     &at<&S::tabletop, &T::contact_height>},
    {"segmentation",
     "attach_strays",
     "",
     {},
     "Points over a table that are in no cluster go to the object or table they lie on; false: to the "
     "background",
     &at<&S::tabletop, &T::attach_strays>},

    {"existence", "pose_shift", "m", within(0, 1),
     "Largest sideways error of the pose of a node or scan that is searched out, and the "
     "smallest motion of an object that is believed; 0.03 for a hand-held camera. What was "
     "mapped from where the sensor still is, and what other nodes of the scan show the error of, "
     "is searched within 0.3 of it",
     &at<&S::existence, &E::pose_shift>},
    {"existence", "pose_depth", "m", within(0, 1), "The same error along the beam",
     &at<&S::existence, &E::pose_depth>},
    {"existence", "window", "m", within(0, 0.1),
     "Half width of the neighbourhood on the node's surface that a beam is compared with",
     &at<&S::existence, &E::window>},
    {"existence", "tolerance", "m", within(0, 1),
     "Added to 0.87 voxels and 3 sigma of the range, within which a beam ends on the node",
     &at<&S::existence, &E::tolerance>},
    {"existence", "min_beams", "beams", count,
     "Fewer beams that end on or beyond a node say nothing about it", &at<&S::existence, &E::min_beams>},
    {"existence", "min_visible", "", share,
     "Share of the beams towards a node that must end on or beyond it, or the scan says nothing",
     &at<&S::existence, &E::min_visible>},
    {"existence", "min_in_view", "", share,
     "Share of a node that must lie inside the image, or the scan says nothing",
     &at<&S::existence, &E::min_in_view>},
    {"existence", "max_beams", "beams", count, "Beams that are compared for one node and scan, at most",
     &at<&S::existence, &E::max_beams>},

    {"exploration", "viewpoint_radius", "m", aboveUpTo(0, 100),
     "Viewpoints are drawn no farther than this from the outline of a table",
     &at<&S::exploration, &A::viewpoints, &V::radius>},
    {"exploration", "candidates", "", within(1, 10000), "Viewpoints of which the best is chosen",
     &at<&S::exploration, &A::viewpoints, &V::candidates>},
    {"exploration", "angular_bins", "", within(1, 10000),
     "Directions around a table in each of which as many viewpoints are drawn as there is room for",
     &at<&S::exploration, &A::viewpoints, &V::angular_bins>},
    {"exploration", "gain", "", any,
     "Expected information of a viewpoint (Eq. 15): unknown cells on each beam times their change of entropy "
     "(the "
     "paper), or distinct unknown cells swept",
     &at<&S::exploration, &A::gain, &G::measure>},
    {"exploration", "unknown_space", "", any,
     "Whether expected beams pass through unknown cells (the paper), or only with a probability that falls "
     "with "
     "the way",
     &at<&S::exploration, &A::gain, &G::unknown_space>},
    {"exploration", "attenuation", "m", aboveUpTo(0, 100),
     "`occluding`: after this way through unknown space the share 1/e of the beams is left",
     &at<&S::exploration, &A::gain, &G::attenuation>},
    {"exploration", "gain_columns", "", within(1, 4096),
     "Expected beams of a viewpoint: columns of a coarse image", &at<&S::exploration, &A::gain, &G::columns>},
    {"exploration", "gain_rows", "", within(1, 4096), "See `gain_columns`",
     &at<&S::exploration, &A::gain, &G::rows>},
    {"exploration", "gain_cell", "m", aboveUpTo(0, 1), "Cell of the grid that expected beams go through",
     &at<&S::exploration, &A::cell>},
    {"exploration", "cleared_resolution", "m", aboveUpTo(0, 1),
     "Voxel of what all beams together say of the space over a table",
     &at<&S::exploration, &A::cleared_resolution>},
    {"exploration", "space_margin", "m", within(0, 10),
     "The space in which objects may stand reaches so far beyond the outline of the table",
     &at<&S::exploration, &A::space, &TableSpace::margin>},
    {"exploration", "space_height", "m", aboveUpTo(0, 10), "How high that space is, at least",
     &at<&S::exploration, &A::space, &TableSpace::height>},
    {"exploration", "utility", "", any,
     "Of gain and cost (s): gain^(alpha / (1 - alpha)) / cost, or alpha gain - (1 - alpha) cost (Eq. 13)",
     &at<&S::exploration, &A::utility>},
    {"exploration", "alpha", "", share, "Weight of the gain in Eq. 13", &at<&S::exploration, &A::alpha>},
    {"exploration", "tau", "", share,
     "A viewpoint is worth a trip if its gain is more than this share of the table's first one; a table "
     "without such is explored",
     &at<&S::exploration, &A::tau>},
    {"exploration", "first_look", "scans", within(1, 1000),
     "Scans all around at the start, for the background", &at<&S::exploration, &A::first_look>},
    {"exploration", "max_views", "scans", count, "Viewpoints of one table, at most",
     &at<&S::exploration, &A::max_views>},
    {"exploration", "grid_cell", "m", aboveUpTo(0, 1), "Cell of the traversability map",
     &at<&S::exploration, &A::traversability, &TraversabilityConfig::cell>},
    {"exploration", "lowest_obstacle", "m", within(0, 10), "What is lower above the floor is driven over",
     &at<&S::exploration, &A::traversability, &TraversabilityConfig::lowest_obstacle>},
    {"exploration", "unknown_is_free", "", any, "Whether the robot may go where nothing has been seen",
     &at<&S::exploration, &A::traversability, &TraversabilityConfig::unknown_is_free>},
    {"exploration", "seed", "", within(0, 4294967295.0), "Seed of the viewpoints",
     &at<&S::exploration, &A::seed>},

    {"limits", "max_inflated_bytes", "bytes", big_count, "Size of a log after decompression",
     &at<&S::limits, &L::max_inflated_bytes>},
    {"limits", "max_inflate_ratio", "", within(1, 1e6),
     "Decompressed by compressed size, looked at beyond 64 MB", &at<&S::limits, &L::max_inflate_ratio>},
    {"limits", "max_object_bytes", "bytes", big_count, "Size of one object of a log",
     &at<&S::limits, &L::max_object_bytes>},
    {"limits", "max_points", "points", big_count, "Points of one scan", &at<&S::limits, &L::max_points>},
    {"limits", "max_memory", "MB", above(0),
     "Memory of the program: a scan that is expected to exceed it is refused, what was mapped is committed; "
     "none: "
     "nine tenths of the machine's",
     &at<&S::limits, &L::max_memory>, true},
    {"limits", "max_nodes", "nodes", big_count, "Nodes of the hierarchy", &at<&S::limits, &L::max_nodes>},
    {"limits", "max_depth", "", within(1, 1000), "Depth of the hierarchy", &at<&S::limits, &L::max_depth>},
    {"limits", "max_skipped_share", "", share,
     "Share of the 3D scans that may be skipped; beyond it the map is written, but the exit code is 3",
     &at<&S::limits, &L::max_skipped_share>},
});

constexpr auto settings_orders = std::to_array<Order<Settings>>({
    {&at<&S::sensor, &SensorConfig::min_range>, &at<&S::sensor, &SensorConfig::max_range>, true},
    {&at<&S::tabletop, &T::table_height_min>, &at<&S::tabletop, &T::table_height_max>, true},
    {&at<&S::tabletop, &T::min_object_height>, &at<&S::tabletop, &T::object_height_max>, true},
    {&at<&S::tabletop, &T::min_object_size>, &at<&S::tabletop, &T::object_size_max>, true},
    {&at<&S::existence, &E::min_beams>, &at<&S::existence, &E::max_beams>, false},
});

constexpr auto label_keys = std::to_array<Key<LabelProfile>>({
    {"label.NAME", "resolution", "m", within(0.0001, 10), "Edge of the smallest voxel", &at<&P::resolution>},
    {"label.NAME", "max_range", "m", above(0),
     "As `[sensor] max_range`, for nodes of this label; the smaller counts", &at<&P::max_range>, true},
    {"label.NAME", "max_memory", "MB", above(0),
     "A scan that is expected to take the octree of a node beyond this is refused (exit code 6)",
     &at<&P::max_memory>, true},
    {"label.NAME", "prob_hit", "", above_half,
     "Probability of being occupied that a beam's end gives a voxel", &at<&P::occupancy, &O::prob_hit>},
    {"label.NAME", "prob_miss", "", below_half, "The same for a voxel that a beam passes through",
     &at<&P::occupancy, &O::prob_miss>},
    {"label.NAME", "clamping_min", "", probability_range, "Least probability that a voxel can get",
     &at<&P::occupancy, &O::clamping_min>},
    {"label.NAME", "clamping_max", "", probability_range, "Largest probability that a voxel can get",
     &at<&P::occupancy, &O::clamping_max>},
    {"label.NAME", "occupancy_threshold", "", probability_range,
     "Probability from which a voxel counts as occupied", &at<&P::occupancy, &O::occupancy_threshold>},
    {"label.NAME", "frame", "", any,
     "Axes of a new node: of the world, or the principal components of its first segment; the root's are the "
     "world's",
     &at<&P::frame>},
    {"label.NAME", "carve", "", any,
     "Beams that clear the node's free space: of its own segments (the paper), or all of the scan that cross "
     "its box",
     &at<&P::carve>},
    {"label.NAME", "grazing", "", any,
     "Whether a beam that grazes the surface it ends on clears voxels of it (stock OctoMap), or spares them",
     &at<&P::grazing>},
    {"label.NAME", "existence", "", any,
     "Whether nodes of this label are removed when they are gone (Eq. 8); the root never is",
     &at<&P::existence_enabled>},
    {"label.NAME", "existence_prior", "", probability_range, "P(n) of Eq. 8", &at<&P::existence, &X::prior>},
    {"label.NAME", "p_present", "", above_half,
     "P(n given z) of a scan that clearly shows the node; also where a new node starts",
     &at<&P::existence, &X::p_present>},
    {"label.NAME", "p_absent", "", below_half,
     "P(n given z) of a scan that clearly shows that the node is gone", &at<&P::existence, &X::p_absent>},
    {"label.NAME", "existence_clamp_min", "", below_half, "Least probability of existence",
     &at<&P::existence, &X::clamp_min>},
    {"label.NAME", "existence_clamp_max", "", above_half,
     "Largest probability of existence, so that a node can die after few contradictions",
     &at<&P::existence, &X::clamp_max>},
});

constexpr auto label_orders = std::to_array<Order<LabelProfile>>({
    {&at<&P::occupancy, &O::clamping_min>, &at<&P::occupancy, &O::clamping_max>, true},
    {&at<&P::occupancy, &O::clamping_min>, &at<&P::occupancy, &O::occupancy_threshold>, true},
    {&at<&P::occupancy, &O::occupancy_threshold>, &at<&P::occupancy, &O::clamping_max>, false},
    {&at<&P::existence, &X::p_absent>, &at<&P::existence, &X::prior>, true},
    {&at<&P::existence, &X::prior>, &at<&P::existence, &X::p_present>, true},
});

constexpr auto rule_keys = std::to_array<Key<LabelRule>>({
    {"label.OWN", "rule", "", any,
     "What the limits below name: nothing, clusters, which count as "
     "objects, or planes, which count as tables",
     &at<&R::kind>},
    {"label.OWN", "rule_rank", "", within(0, 1000),
     "Rules are asked by rank, then by label; the first that fits names", &at<&R::rank>},
    {"label.OWN", "min_length", "m", within(0, 1000),
     "Larger side in the plan of the upright box around a segment", &at<&R::min_length>},
    {"label.OWN", "max_length", "m", above(0), "See `min_length`", &at<&R::max_length>, true},
    {"label.OWN", "min_width", "m", within(0, 1000), "Smaller side of that box in the plan",
     &at<&R::min_width>},
    {"label.OWN", "max_width", "m", above(0), "See `min_width`", &at<&R::max_width>, true},
    {"label.OWN", "min_height", "m", within(0, 1000), "From the lowest to the highest point of a segment",
     &at<&R::min_height>},
    {"label.OWN", "max_height", "m", above(0), "See `min_height`", &at<&R::max_height>, true},
    {"label.OWN", "min_elevation", "m", within(-1000, 1000), "z of the lowest point in the world frame",
     &at<&R::min_elevation>},
    {"label.OWN", "max_elevation", "m", within(-1000, 1000), "See `min_elevation`", &at<&R::max_elevation>},
    {"label.OWN", "shape", "", any,
     "Proportions: flat, height below a third of the length; tall, height above one and a half lengths; "
     "compact, in "
     "between",
     &at<&R::shape>},
});

constexpr auto rule_orders = std::to_array<Order<LabelRule>>({
    {&at<&R::min_length>, &at<&R::max_length>, true},
    {&at<&R::min_width>, &at<&R::max_width>, true},
    {&at<&R::min_height>, &at<&R::max_height>, true},
    {&at<&R::min_elevation>, &at<&R::max_elevation>, true},
});

}  // namespace

std::span<const Key<LabelRule>> ruleKeys() {
  return rule_keys;
}
std::span<const Order<LabelRule>> ruleOrders() {
  return rule_orders;
}
std::span<const Key<Settings>> settingsKeys() {
  return settings_keys;
}
std::span<const Order<Settings>> settingsOrders() {
  return settings_orders;
}
std::span<const Key<LabelProfile>> labelKeys() {
  return label_keys;
}
std::span<const Order<LabelProfile>> labelOrders() {
  return label_orders;
}

LabelProfile defaultProfile(const Label& label) {
  LabelProfile profile;
  profile.grazing = Grazing::spare;
  if (label == labels::background) {
    profile.resolution = 0.05;
    profile.frame = FrameChoice::world;
    // The space above the tables is cleared by beams that end on them: navigation needs it.
    profile.carve = Carve::scan;
    profile.grazing = Grazing::clear;
    profile.existence_enabled = false;
  } else if (label == labels::table) {
    profile.resolution = 0.01;
  } else if (label == labels::object) {
    profile.resolution = 0.002;
  }
  return profile;
}

}  // namespace hoctomap::keys
