# Builds swell-render with all trials in it:
#   cmake -DSOURCE=FOLDER -DSCRATCH=FOLDER -P build_trials.cmake
# The program is SCRATCH/build/bin/swell-render, for AVX2 alone.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${SCRATCH}/source)
file(GLOB entries ${SOURCE}/*)
list(REMOVE_ITEM entries ${SOURCE}/build ${SOURCE}/tests)
file(COPY ${entries} DESTINATION ${SCRATCH}/source)
file(GLOB patches ${CMAKE_CURRENT_LIST_DIR}/*.patch)
foreach(patch IN LISTS patches)
  run(patch -d ${SCRATCH}/source -p1 --no-backup-if-mismatch -i ${patch})
endforeach()
run(${CMAKE_COMMAND} -G Ninja -S ${SCRATCH}/source -B ${SCRATCH}/build -DCMAKE_BUILD_TYPE=Release
  -DCMAKE_UNITY_BUILD=ON -DSWELL_SIMD=avx2 -DSWELL_BUILD_TESTS=OFF)
run(${CMAKE_COMMAND} --build ${SCRATCH}/build --target swell-render)
