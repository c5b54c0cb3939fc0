// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hoctomap {

/// From now on this process can read files and use what it has open, and no more: it makes, changes and
/// removes no file, starts no program and no other process, reaches no network and looks into no process.
/// What it tries all the same fails with an error. To be called before it starts threads.
///
/// By Landlock (files; Linux 5.13) and a seccomp filter (the rest). Where the kernel, or a container around
/// us, knows one of them only, that one holds; `confine` itself never fails.
void confine();

}  // namespace hoctomap
