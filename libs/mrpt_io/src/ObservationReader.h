// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CArchive.h>

#include <deque>
#include <memory>
#include <optional>

#include "hoctomap/mrpt_io/LogFileStream.h"
#include "hoctomap/mrpt_io/ReadProgress.h"

namespace hoctomap {

/// One observation of a log, whatever it was packed in. Poses are null where there are none.
struct Observed {
  mrpt::obs::CObservation::Ptr observation;
  StreamPosition position;                      ///< of the object of the file that it came in
  std::shared_ptr<const Pose> map_T_base;       ///< with a CSimpleMap: the pose of its keyframe
  std::shared_ptr<const Pose> odometry_T_base;  ///< with actions: their odometry, summed up so far
};

/// Streams the observations of one log: observations, sensory frames, actions, whole CRawlog and CSimpleMap
/// objects, in the order of the file, one object of the file in memory at a time.
class ObservationReader {
 public:
  /// @throws InputError if the log cannot be opened.
  ObservationReader(const LogReadOptions& options, std::uint32_t log, ReadProgress& progress);

  /// The next observation, or nothing at the clean end of the log.
  /// @throws InputError (damage; with file, object and byte), LimitError (a budget or memory).
  [[nodiscard]] std::optional<Observed> next();

  [[nodiscard]] std::uint64_t objectsRead() const { return next_object_; }
  [[nodiscard]] std::uint64_t nullObjects() const { return null_objects_; }
  [[nodiscard]] std::uint64_t otherObjects() const { return other_objects_; }  ///< of no use for mapping
  [[nodiscard]] bool hasSimpleMap() const { return simple_map_; }
  [[nodiscard]] bool compressed() const { return stream_.compressed(); }
  /// Whether all observations of the objects read so far are handed out.
  [[nodiscard]] bool drained() const { return ready_.empty(); }
  /// The error of this kind with file, object and byte.
  template <class E>
  [[nodiscard]] E errorHere(const std::string& what) const;

 private:
  bool atEnd();
  mrpt::serialization::CSerializable::Ptr readObject();
  [[noreturn]] void throwDamage(const std::exception& error);
  void unpack(const mrpt::serialization::CSerializable::Ptr& object);
  void unpackFrame(const mrpt::serialization::CSerializable& frame,
                   const std::shared_ptr<const Pose>& map_T_base);
  void unpackRawlog(const mrpt::serialization::CSerializable& rawlog);
  void unpackSimpleMap(const mrpt::serialization::CSerializable& map);
  void addAction(const mrpt::serialization::CSerializable& actions);
  void add(const mrpt::obs::CObservation::Ptr& observation, const std::shared_ptr<const Pose>& map_T_base);

  std::string name_;
  LogFileStream stream_;
  ReadProgress& progress_;
  StreamPosition position_;
  std::uint64_t next_object_ = 0;
  std::uint64_t null_objects_ = 0;
  std::uint64_t other_objects_ = 0;
  bool simple_map_ = false;
  std::shared_ptr<const Pose> odometry_;
  std::deque<Observed> ready_;
};

template <class E>
E ObservationReader::errorHere(const std::string& what) const {
  return E(name_ + ": object " + std::to_string(position_.object) + " at byte " +
           std::to_string(position_.offset) + ": " + what);
}

/// Makes MRPT know the classes of logs: the linker drops unreferenced libraries and their registration.
void registerLogClasses();

/// What MRPT's exception says, without its stack trace, on one line.
[[nodiscard]] std::string messageOf(const std::exception& error);

}  // namespace hoctomap
