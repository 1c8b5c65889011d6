# Which headers are installed: those that a program that embeds the library includes, and what
# these include themselves. Everything else is private, also in the installed package.
set(swell_entry_headers
  math/elementary.h math/parallel.h math/random.h math/simd_target.h math/view.h
  ocean/coast/coast.h ocean/spectrum/dispersion.h ocean/open_sea/sea.h ocean/spectrum/sea_scale.h ocean/spectrum/spectrum.h ocean/velocity.h
  lod/mesh_query.h lod/plane.h lod/radial_grid.h lod/roam.h lod/uniform_grid.h
  texture/image/image_io.h texture/improved_noise.h texture/normal_map.h texture/perlin.h
  texture/uv_noise.h
  raster/pass.h
  scene/objects.h scene/scene.h scene/settings.h scene/terrain.h scene/water.h
  shapes/object_ray.h
  render/frame.h render/measure/eye_place.h render/measure/lidar.h render/measure/lidar_patterns.h
  render/measure/mesh_error.h render/measure/pick.h render/quality/governor.h render/world_view.h)

# swell_find_public_headers(OUT SOURCE_FOLDER)
# The entry headers and all that they reach by #include "...", as paths from the source folder.
function(swell_find_public_headers out source)
  set(found "")
  set(open ${swell_entry_headers})
  while(open)
    list(POP_FRONT open header)
    if(header IN_LIST found)
      continue()
    endif()
    if(NOT EXISTS ${source}/${header})
      message(FATAL_ERROR "${header} is not there, but cmake/PublicHeaders.cmake or a public header names it")
    endif()
    list(APPEND found ${header})
    file(STRINGS ${source}/${header} lines REGEX "^ *# *include +\"")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^[^\"]*\"([^\"]*)\".*" "\\1" included "${line}")
      list(APPEND open ${included})
    endforeach()
  endwhile()
  list(SORT found)
  set(${out} ${found} PARENT_SCOPE)
endfunction()
