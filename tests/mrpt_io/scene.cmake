# SPDX-License-Identifier: BSD-3-Clause
set(HOCTOMAP_MRPT_IO_SCENE_TESTS scene_test.cpp)
