# make_material_unit(NAME SOURCE FOLDER): writes FOLDER/NAME_simd.cpp, the unit of a material of
# SOURCE/render, whose struct has its name with a capital.
function(make_material_unit name source folder)
  string(SUBSTRING ${name} 0 1 first)
  string(TOUPPER ${first} first)
  string(SUBSTRING ${name} 1 -1 rest)
  set(MATERIAL ${first}${rest})
  configure_file(${source}/render/tile/material_unit.cpp.in ${folder}/${name}_simd.cpp @ONLY)
endfunction()
