# One test binary per folder of src/azulejo, of its *_test.cpp files, and one for the command.
find_package(GTest REQUIRED)
include(GoogleTest)
enable_testing()

set(azulejo_test_properties TIMEOUT 900)
if(AZULEJO_SANITIZE MATCHES "thread")
  list(APPEND azulejo_test_properties ENVIRONMENT "TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/tsan.supp")
endif()

set(azulejo_test_folders)
foreach(file IN LISTS azulejo_tests)
  cmake_path(GET file PARENT_PATH folder)
  cmake_path(GET folder FILENAME folder)
  list(APPEND azulejo_test_folders ${folder})
endforeach()
list(REMOVE_DUPLICATES azulejo_test_folders)

foreach(folder IN LISTS azulejo_test_folders)
  set(files ${azulejo_tests})
  list(FILTER files INCLUDE REGEX "/${folder}/[^/]*$")
  set(target test_${folder})
  add_executable(${target} ${files})
  # Tests see internal headers and symbols: they link the library's objects, not its shared face.
  target_link_libraries(${target} PRIVATE azulejo_objects azulejo_flags azulejo_libraries GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE AZULEJO_SOURCE_FOLDER="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(${target} DISCOVERY_TIMEOUT 60 PROPERTIES ${azulejo_test_properties})
endforeach()

file(GLOB azulejo_cli_tests CONFIGURE_DEPENDS apps/cli/*_test.cpp)
add_executable(test_cli ${azulejo_cli_tests})
add_dependencies(test_cli azulejo_command)
target_link_libraries(test_cli PRIVATE azulejo_objects azulejo_flags azulejo_libraries GTest::gtest_main)
target_compile_definitions(test_cli PRIVATE AZULEJO_COMMAND="$<TARGET_FILE:azulejo_command>" AZULEJO_VERSION="${PROJECT_VERSION}"
  AZULEJO_SOURCE_FOLDER="${PROJECT_SOURCE_DIR}")
gtest_discover_tests(test_cli DISCOVERY_TIMEOUT 60 PROPERTIES ${azulejo_test_properties})

# All that the README and the gallery show can be done; without models that aren't made here, tests need no network.
if(NOT AZULEJO_SANITIZE AND NOT AZULEJO_COVERAGE)
  add_test(NAME tour COMMAND ${PROJECT_SOURCE_DIR}/examples/tour $<TARGET_FILE:azulejo_command> ${PROJECT_BINARY_DIR}/tour)
  set_tests_properties(tour PROPERTIES TIMEOUT 300)
endif()
