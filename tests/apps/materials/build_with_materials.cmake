# Builds swell-render with another list of materials, from what is built already: copies render/,
# changes the list, and compiles the few sources that read it.
#   cmake -DCHANGE=checkerboard|no_objects -DBUILD=FOLDER -DSOURCE=FOLDER -DSCRATCH=FOLDER
#     -DSIMD=avx2,avx512 -DNINJA=FILE -DAR=FILE -DCODEC=FILE -P build_with_materials.cmake
# The program is SCRATCH/CHANGE/swell-render. The build folder's generator is Ninja.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${BUILD} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The materials as a reader of docs/understand/frame.md changes them.
function(change_materials folder)
  if(CHANGE STREQUAL "checkerboard")
    run(patch -d ${folder} -p1 --no-backup-if-mismatch
      -i ${SOURCE}/examples/checkerboard/checkerboard.patch)
    return()
  endif()
  # Objects: their lines in the list, and the files.
  set(materials ${folder}/render/materials)
  file(READ ${materials}/list.h text)
  string(REGEX REPLACE "#include \"render/materials/object[^\n]*\n" "" text "${text}")
  string(REGEX REPLACE "\n *Object, *//" "" text "${text}")
  file(WRITE ${materials}/list.h "${text}")
  file(REMOVE ${materials}/object.h ${materials}/object-inl.h)
  file(WRITE ${materials}/object.cpp "")  # the unity build still names it
endfunction()

# The files of render/ that include one of `found`, in any number of steps, and these themselves.
function(find_readers folder found out)
  file(GLOB_RECURSE files RELATIVE ${folder} ${folder}/render/*.h ${folder}/render/*.cpp)
  foreach(file IN LISTS files)
    file(STRINGS ${folder}/${file} includes_${file} REGEX "^#include \"render/")
  endforeach()
  set(news ${found})
  while(news)
    list(JOIN news "|" any)
    string(REPLACE "." "\\." any "${any}")
    set(news "")
    foreach(file IN LISTS files)
      if(NOT file IN_LIST found AND "${includes_${file}}" MATCHES "\"(${any})\"")
        list(APPEND news ${file})
      endif()
    endforeach()
    list(APPEND found ${news})
  endwhile()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

set(root ${SCRATCH}/${CHANGE})
file(REMOVE_RECURSE ${root})
file(COPY ${SOURCE}/render DESTINATION ${root})
change_materials(${root})
find_readers(${root} "render/materials/list.h" readers)

# compile FILE COMMAND: as the build does, but from the copy.
function(compile file command)
  string(REPLACE "${BUILD}/include/render " "${root} " command "${command}")
  string(REPLACE "${BUILD}/render/units" "${root}/units" command "${command}")
  string(REPLACE " ${SOURCE}/${file}" " ${root}/${file}" command "${command}")
  # The archive knows its members by the object's name.
  get_filename_component(name ${file} NAME)
  string(REGEX REPLACE " -o [^ ]+" " -o ${root}/${name}.o" command "${command}")
  separate_arguments(command UNIX_COMMAND "${command}")
  run(${command})
  set(objects ${objects} ${root}/${name}.o PARENT_SCOPE)
endfunction()

file(READ ${BUILD}/compile_commands.json commands)
string(JSON count LENGTH "${commands}")
math(EXPR last "${count} - 1")
set(objects "")
foreach(i RANGE ${last})
  string(JSON file GET "${commands}" ${i} file)
  string(JSON command GET "${commands}" ${i} command)
  if(file MATCHES "/render/units/(.*)_simd.cpp$")
    set(unit ${CMAKE_MATCH_1})
    set(unit_command "${command}")
  endif()
  file(RELATIVE_PATH file ${SOURCE} ${file})
  if(file IN_LIST readers)
    compile(${file} "${command}")
  elseif(file MATCHES "/swell_render.dir/Unity/")  # several sources, most of which read it
    get_filename_component(name ${file} NAME)
    file(READ ${SOURCE}/${file} text)
    string(REPLACE "\"${SOURCE}/render/" "\"${root}/render/" text "${text}")
    file(WRITE ${root}/${name} "${text}")
    string(REPLACE " ${SOURCE}/${file}" " ${root}/${name}" command "${command}")
    compile(${name} "${command}")
  endif()
endforeach()

# The materials' units, as render/CMakeLists.txt makes them.
include(${SOURCE}/cmake/MaterialUnit.cmake)
read_materials(${root} materials)
set(units "")
string(REPLACE "," ";" targets "${SIMD}")
foreach(name IN LISTS materials)
  make_material_units(${name} ${root} ${root}/units "${targets}" units)
endforeach()
foreach(file IN LISTS units)
  get_filename_component(file ${file} NAME)
  string(REPLACE "/${unit}_simd.cpp" "/${file}" command "${unit_command}")
  compile(units/${file} "${command}")
endforeach()
list(LENGTH objects compiled)
if(compiled EQUAL 0)
  message(FATAL_ERROR "no source of render/ reads the list of materials: ${readers}")
endif()
message(STATUS "${CHANGE}: ${compiled} sources compiled")

# Put them into a copy of the library, and link as the build does.
file(COPY ${BUILD}/render/libswell_render.a DESTINATION ${root})
run(${AR} r ${root}/libswell_render.a ${objects})
execute_process(COMMAND ${NINJA} -t commands bin/swell-render WORKING_DIRECTORY ${BUILD}
  OUTPUT_VARIABLE link COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "[^\n]* -o bin/swell-render [^\n]*" link "${link}")
string(REPLACE " -o bin/swell-render " " -o ${root}/swell-render " link "${link}")
string(REPLACE " render/libswell_render.a " " ${root}/libswell_render.a " link "${link}")
run(sh -c "${link}")
file(CREATE_LINK ${CODEC} ${root}/libswell_image_codec.so SYMBOLIC)
