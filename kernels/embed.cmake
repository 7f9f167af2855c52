# cmake -DKERNELS=folder -DTABLE=name -DOUT=file.cpp -P embed.cmake: writes a table of the folder's kernel files,
# path, text, path, text, ..., nullptr. Paths are written as the kernels include each other: "kernels/vec.h".
file(GLOB files LIST_DIRECTORIES false ${KERNELS}/*.h ${KERNELS}/solids/*.h ${KERNELS}/packets/*.h ${KERNELS}/*.cl ${KERNELS}/*.c)
list(SORT files)

set(table "// Made by kernels/embed.cmake.\nextern const char* const ${TABLE}[];\n")
string(APPEND table "const char* const ${TABLE}[] = {\n")
foreach(file IN LISTS files)
  file(RELATIVE_PATH name ${KERNELS} ${file})
  file(READ ${file} text)
  string(APPEND table "\"kernels/${name}\",\nR\"clucida_kernel(")
  string(APPEND table "${text}")
  string(APPEND table ")clucida_kernel\",\n")
endforeach()
string(APPEND table "nullptr};\n")
file(WRITE ${OUT} "${table}")
