# SPDX-License-Identifier: BSD-3-Clause
set(HOCTOMAP_ENGINE_TESTS block_scan_update_test.cpp block_ray_test.cpp block_scenes.cpp)
