// SPDX-License-Identifier: BSD-3-Clause
// The pipe from the log reader, which may have been taken over by the log that it reads.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <functional>

#include "FuzzTarget.h"
#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/ScanStream.h"

namespace hoctomap::fuzz {

namespace {

UniqueFd memoryFile() {
  UniqueFd fd(memfd_create("stream", MFD_CLOEXEC));
  require(fd.get() >= 0, "there are files in memory");
  return fd;
}

std::string streamOf(const std::vector<StreamMessage>& messages) {
  const UniqueFd fd = memoryFile();
  ScanStreamWriter writer(fd.get());
  for (const auto& message : messages) writer.write(message, {0, 3, 500});
  std::string bytes(static_cast<std::size_t>(lseek(fd.get(), 0, SEEK_CUR)), '\0');
  require(pread(fd.get(), bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()), "it is read");
  return bytes;
}

}  // namespace

std::vector<std::string> seeds() {
  const StreamHeader header{2, 2, "identity", {"ab"}, {{"RGBD", "CObservation3DRangeScan", 2, 4, 3}}};
  const DepthScan depth{0,
                        1.5,
                        "RGBD",
                        Pose(1, 2, 3, 0.1, 0.2, 0.3),
                        {{4, 3, 5.0, 5.0, 2.0, 1.5}, std::vector<float>(12, 1.F)}};
  return {streamOf({header, depth, CloudScan{1, 2.5, "l", Pose(), {{1.F, 2.F, 3.F}}}, StreamEnd{2, 0}}),
          streamOf({StreamWarning{"w"}, header, ObjectMotion{1.0, NodeId{2}, Pose()},
                    SkippedScan{0, 1.0, "x"}, TruthPose{1.0, "t", Pose()}, StreamEnd{1, 1}}),
          streamOf({StreamError{3, "no"}})};
}

void read(std::string_view bytes) {
  const UniqueFd fd = memoryFile();
  require(write(fd.get(), bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()), "it is written");
  lseek(fd.get(), 0, SEEK_SET);
  StreamLimits limits;
  limits.max_points = 10'000;
  ScanStreamReader reader(fd.get(), limits);
  while (!std::holds_alternative<StreamEnd>(reader.read())) {
  }
}

}  // namespace hoctomap::fuzz
