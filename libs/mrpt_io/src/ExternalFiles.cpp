// SPDX-License-Identifier: BSD-3-Clause
#include "ExternalFiles.h"

#include <fcntl.h>
#include <linux/openat2.h>
#include <mrpt/io/lazy_load_path.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

namespace {

int openBeneath(int folder, const std::string& name) {
  open_how how{};
  how.flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS;
  return static_cast<int>(::syscall(SYS_openat2, folder, name.c_str(), &how, sizeof how));
}

}  // namespace

std::filesystem::path imagesFolder(const std::filesystem::path& log) {
  const auto beside = [&](const std::string& name) { return log.parent_path() / name; };
  const std::string stem = log.stem().string();
  std::error_code ignored;
  for (const auto& folder :
       {beside(stem + "_Images"), beside(stem + "_images"), beside("Images"), beside("images")}) {
    if (std::filesystem::is_directory(folder, ignored)) return folder;
  }
  return beside(stem + "_Images");
}

ExternalFile::ExternalFile(const std::filesystem::path& folder, const std::string& name) : name_(name) {
  const auto refuse = [&](const std::string& why) {
    throw InputError("external file '" + escapedText(name, 300) + "': " + why);
  };
  if (name.find('\0') != std::string::npos) refuse("the name holds a zero byte");
  // MRPT takes a leading drive letter for an absolute path, on every system.
  const bool drive = name.size() > 1 && name[1] == ':';
  if (name.starts_with('/') || name.starts_with('\\') || drive) refuse("the name is absolute");
  for (const auto& part : std::filesystem::path(name)) {
    if (part == "..") refuse("the name leads out of the images folder");
  }
  if (name.empty()) return;

  const UniqueFd root(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (root.get() < 0) return;
  UniqueFd file(openBeneath(root.get(), name));
  if (file.get() < 0) {
    if (errno == ELOOP || errno == EXDEV) refuse("the name leads through a symbolic link");
    return;
  }
  struct stat info {};
  if (::fstat(file.get(), &info) == 0 && S_ISREG(info.st_mode)) file_ = std::move(file);
}

std::string ExternalFile::sha256() const {
  Sha256 hash;
  std::vector<char> buffer(std::size_t{1} << 18);
  for (off_t at = 0;;) {
    const ssize_t size = ::pread(file_.get(), buffer.data(), buffer.size(), at);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) throw InputError("external file '" + escapedText(name_, 300) + "': cannot be read");
    if (size == 0) return hash.hex();
    hash.add({buffer.data(), static_cast<std::size_t>(size)});
    at += size;
  }
}

bool loadExternals(const mrpt::obs::CObservation& observation, const std::filesystem::path& folder) {
  try {
    mrpt::io::setLazyLoadPathBase(folder.string());
    observation.load();
    return true;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace hoctomap
