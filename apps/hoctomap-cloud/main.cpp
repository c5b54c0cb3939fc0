// SPDX-License-Identifier: BSD-3-Clause
// The helper of `hoctomap import pcd`: the only program that links Open3D. Takes names of files on stdin, as
// warnings of a scan stream, and answers each on stdout with a cloud or an error. Not meant to be called by
// hand.
#include <sys/resource.h>
#include <unistd.h>

#include <iostream>

#include "CloudFile.h"
#include "Confinement.h"
#include "ProcessGuards.h"

namespace {

hoctomap::StreamMessage answerTo(const std::string& file) {
  try {
    return hoctomap::readCloudFile(file);
  } catch (const std::exception& error) {
    return hoctomap::StreamError{hoctomap::exitCodeOf(error), error.what()};
  }
}

/// No core files, no files at all, and no more memory than the reader of logs has.
void limitProcess() {
  const auto set = [](auto resource, rlim_t value) {
    const rlimit limit{value, value};
    setrlimit(resource, &limit);
  };
  set(RLIMIT_CORE, 0);
  set(RLIMIT_FSIZE, 0);
#ifndef HOCTOMAP_SANITIZED  // which maps terabytes
  constexpr rlim_t kAddressSpace = rlim_t{4} << 30;
  set(RLIMIT_AS, kAddressSpace);
#endif
}

void serve(int stream) {
  hoctomap::ScanStreamReader requests(STDIN_FILENO);
  hoctomap::ScanStreamWriter answers(stream);
  for (;;) {
    const hoctomap::StreamMessage request = requests.read();
    const auto* name = std::get_if<hoctomap::StreamWarning>(&request);
    if (name != nullptr) answers.write(answerTo(name->text));
  }
}

}  // namespace

int main() {
  if (isatty(STDIN_FILENO) || isatty(STDOUT_FILENO)) {
    std::cerr << "hoctomap-cloud: is a helper of `hoctomap import pcd`\n";
    return 2;
  }
  hoctomap::dieWithParent();
  limitProcess();
  const int stream = hoctomap::takeOverOutput();
  hoctomap::confine();
  try {
    serve(stream);
  } catch (const hoctomap::Error&) {
    return 0;  // no further requests
  }
}
