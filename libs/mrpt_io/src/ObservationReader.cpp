// SPDX-License-Identifier: BSD-3-Clause
#include "ObservationReader.h"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <new>
#include <stdexcept>

#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

using mrpt::serialization::CSerializable;

namespace {

/// Memory that could not be had, also when MRPT has wrapped the exception: sizes in a log are counts that
/// were never checked, so this is how a hostile one shows.
bool isOutOfMemory(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) || dynamic_cast<const std::length_error*>(&error))
    return true;
  const std::string_view text = error.what();
  for (const std::string_view sign :
       {"bad_alloc", "bad_array_new_length", "std::length_error", "_M_default_append", "vector::reserve",
        "basic_string::", "Insufficient memory"}) {
    if (text.find(sign) != std::string_view::npos) return true;
  }
  return false;
}

/// Sets a flag for as long as it lives.
class AtWork {
 public:
  explicit AtWork(std::atomic<bool>& flag) : flag_(flag) { flag_ = true; }
  ~AtWork() { flag_ = false; }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;

 private:
  std::atomic<bool>& flag_;
};

}  // namespace

std::string messageOf(const std::exception& error) {
  std::string_view text = error.what();
  constexpr std::string_view kMessage = "Message:";
  // MRPT nests: the innermost message, the last one, is the cause.
  if (const auto at = text.rfind(kMessage); at != std::string_view::npos)
    text.remove_prefix(at + kMessage.size());
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return "unknown error";
  text.remove_prefix(first);
  return escapedText(text.substr(0, text.find('\n')), 300);
}

ObservationReader::ObservationReader(const LogReadOptions& options, std::uint32_t log, ReadProgress& progress)
    : name_(escapedText(options.logs.at(log).string())),
      stream_(options.logs[log], options, progress),
      progress_(progress) {
  position_.log = log;
}

std::optional<Observed> ObservationReader::next() {
  while (ready_.empty()) {
    position_.object = next_object_;
    position_.offset = stream_.position();
    progress_.set(position_);
    if (atEnd()) return std::nullopt;
    const CSerializable::Ptr object = readObject();
    ++next_object_;
    unpack(object);
  }
  Observed observed = std::move(ready_.front());
  ready_.pop_front();
  return observed;
}

bool ObservationReader::atEnd() {
  try {
    // Clean is an end only where an object could start.
    return stream_.atEnd();
  } catch (const LimitError& limit) {
    throw errorHere<LimitError>(limit.what());
  } catch (const InputError& damage) {
    throw errorHere<InputError>(damage.what());
  }
}

CSerializable::Ptr ObservationReader::readObject() {
  stream_.beginObject();
  const AtWork at_work(progress_.in_object);
  try {
    return mrpt::serialization::archiveFrom(stream_).ReadObject();
  } catch (const std::exception& error) {
    throwDamage(error);
  }
}

/// What is wrong with an object: known to the stream if it could not give the bytes, else in MRPT's words.
void ObservationReader::throwDamage(const std::exception& error) {
  try {
    if (stream_.failure()) std::rethrow_exception(stream_.failure());
    if (isOutOfMemory(error)) throw LimitError("asks for more memory than a log may take: it is damaged");
    stream_.rejectBomb();
  } catch (const LimitError& limit) {
    throw errorHere<LimitError>(limit.what());
  } catch (const InputError& damage) {
    throw errorHere<InputError>(damage.what());
  }
  const char* what = next_object_ == 0 ? "this is not a rawlog: " : "cannot be read: ";
  throw errorHere<InputError>(what + messageOf(error));
}

void ObservationReader::unpack(const CSerializable::Ptr& object) {
  if (!object) {
    ++null_objects_;
  } else if (const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object)) {
    add(observation, nullptr);
  } else if (dynamic_cast<const mrpt::obs::CSensoryFrame*>(object.get())) {
    unpackFrame(*object, nullptr);
  } else if (dynamic_cast<const mrpt::obs::CActionCollection*>(object.get())) {
    addAction(*object);
  } else if (dynamic_cast<const mrpt::obs::CRawlog*>(object.get())) {
    unpackRawlog(*object);
  } else if (dynamic_cast<const mrpt::maps::CSimpleMap*>(object.get())) {
    unpackSimpleMap(*object);
  } else {
    ++other_objects_;
  }
}

void ObservationReader::unpackFrame(const CSerializable& frame,
                                    const std::shared_ptr<const Pose>& map_T_base) {
  for (const auto& observation : dynamic_cast<const mrpt::obs::CSensoryFrame&>(frame))
    add(observation, map_T_base);
}

void ObservationReader::unpackRawlog(const CSerializable& object) {
  const auto& rawlog = dynamic_cast<const mrpt::obs::CRawlog&>(object);
  for (const auto& entry : rawlog) {
    // A CRawlog within a CRawlog is nothing that MRPT writes; taking it apart would recurse without bound.
    if (entry && dynamic_cast<const mrpt::obs::CRawlog*>(entry.get()))
      ++other_objects_;
    else
      unpack(entry);
  }
}

void ObservationReader::unpackSimpleMap(const CSerializable& object) {
  simple_map_ = true;
  const auto& map = dynamic_cast<const mrpt::maps::CSimpleMap&>(object);
  for (std::size_t i = 0; i < map.size(); ++i) {
    mrpt::poses::CPose3DPDF::ConstPtr pose;
    mrpt::obs::CSensoryFrame::ConstPtr frame;
    map.get(i, pose, frame);
    if (!pose || !frame) {
      ++null_objects_;
      continue;
    }
    unpackFrame(*frame, std::make_shared<const Pose>(pose->getMeanVal()));
  }
}

void ObservationReader::addAction(const CSerializable& object) {
  for (const auto& action : dynamic_cast<const mrpt::obs::CActionCollection&>(object)) {
    const auto* movement = dynamic_cast<const mrpt::obs::CActionRobotMovement2D*>(action.get_ptr().get());
    if (movement == nullptr || movement->estimationMethod != mrpt::obs::CActionRobotMovement2D::emOdometry)
      continue;
    const Pose before = odometry_ ? *odometry_ : Pose();
    odometry_ = std::make_shared<const Pose>(before + Pose(movement->rawOdometryIncrementReading));
  }
}

void ObservationReader::add(const mrpt::obs::CObservation::Ptr& observation,
                            const std::shared_ptr<const Pose>& map_T_base) {
  if (observation)
    ready_.push_back({observation, position_, map_T_base, odometry_});
  else
    ++null_objects_;
}

}  // namespace hoctomap
