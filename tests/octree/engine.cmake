# SPDX-License-Identifier: BSD-3-Clause
set(HOCTOMAP_ENGINE_TESTS
  block_scan_update_test.cpp block_ray_test.cpp block_scenes.cpp engine_lanes_test.cpp engine_threads_test.cpp marked_reach_test.cpp)
# The engine's vector types are handed between inlined functions only.
set_source_files_properties(engine_lanes_test.cpp marked_reach_test.cpp PROPERTIES COMPILE_OPTIONS -Wno-psabi)
