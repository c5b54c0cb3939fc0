# SPDX-License-Identifier: BSD-3-Clause
# See CMakeLists.txt. Each step stops the test when it fails.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${result}\n${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()

file(READ "${DOWNSTREAM}/../../../package.xml" package_xml)
if(NOT package_xml MATCHES "<version>${VERSION}</version>")
  message(FATAL_ERROR "package.xml has another version than ${VERSION}")
endif()

file(REMOVE_RECURSE "${WORK}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/first" --component development)
file(RENAME "${WORK}/first" "${WORK}/moved")

# Nothing that is installed may know where it was built or first put.
file(GLOB package "${WORK}/moved/${LIBDIR}/cmake/hoctomap/*.cmake")
foreach(file IN LISTS package)
  file(READ "${file}" text)
  foreach(place "${BUILD}" "${WORK}")
    string(FIND "${text}" "${place}" found)
    if(NOT found EQUAL -1)
      message(FATAL_ERROR "${file} names ${place}")
    endif()
  endforeach()
endforeach()

run("${CMAKE_COMMAND}" -S "${DOWNSTREAM}" -B "${WORK}/build" -G Ninja "-DCMAKE_CXX_COMPILER=${COMPILER}"
    "-DCMAKE_PREFIX_PATH=${WORK}/moved" "-DWANTED=${VERSION}")
run("${CMAKE_COMMAND}" --build "${WORK}/build")
run("${WORK}/build/downstream")
if(NOT said MATCHES "table 1 created")
  message(FATAL_ERROR "the downstream program said:\n${said}")
endif()

# All headers of the core, as the compiler has read them: neither OpenCV nor MRPT's observations are among them.
run("${NINJA}" -C "${WORK}/build" -t deps)
set(read "${said}")
if(NOT read MATCHES "hoctomap/mapping/HierarchyMapper.h" OR NOT read MATCHES "hoctomap/config/Settings.h")
  message(FATAL_ERROR "the list of headers is not what it should be")
endif()
string(REGEX MATCHALL "[^ \n]*(opencv|mrpt/(obs|maps|img|opengl)/|embree|assimp|yaml-cpp|nlohmann|Open3D)[^ \n]*" heavy "${read}")
if(heavy)
  message(FATAL_ERROR "the core's headers include ${heavy}")
endif()
