# header_check: each header compiles alone, and twice in one file. Only on demand: ninja header_check
file(GLOB_RECURSE azulejo_headers RELATIVE ${PROJECT_SOURCE_DIR}/src CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/src/azulejo/*.h)
# Those of benchmarks need the peers, which only the bench preset finds.
list(FILTER azulejo_headers EXCLUDE REGEX "_bench\\.h$")
set(checks)
foreach(header IN LISTS azulejo_headers)
  set(check ${PROJECT_BINARY_DIR}/header_check/${header}.cpp)
  file(CONFIGURE OUTPUT ${check} CONTENT "#include \"${header}\"\n#include \"${header}\"\n" @ONLY)
  list(APPEND checks ${check})
endforeach()
add_library(header_check OBJECT EXCLUDE_FROM_ALL ${checks})
target_include_directories(header_check PRIVATE src)
target_link_libraries(header_check PRIVATE azulejo_flags azulejo_libraries)
target_compile_definitions(header_check PRIVATE AZULEJO_SOURCE_FOLDER="${PROJECT_SOURCE_DIR}")
target_compile_options(header_check PRIVATE -fsyntax-only -Werror)
