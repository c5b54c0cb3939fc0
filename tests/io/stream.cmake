# SPDX-License-Identifier: BSD-3-Clause
# Tests of the stream part of libs/io.
set(HOCTOMAP_IO_STREAM_TESTS stream_protocol_test.cpp stream_child_test.cpp)
