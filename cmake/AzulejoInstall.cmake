# Installed: the library, its public headers, a CMake package; the command installs itself.
include(CMakePackageConfigHelpers)

# Public is a header that shows something (AZULEJO_EXPORT) and whatever such a header includes. None of them may
# need another library.
file(GLOB_RECURSE headers RELATIVE ${PROJECT_SOURCE_DIR}/src CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/azulejo/*.h)
set(unread)
foreach(header IN LISTS headers)
  file(STRINGS src/${header} shown REGEX "AZULEJO_EXPORT" LIMIT_COUNT 1)
  if(shown)
    list(APPEND unread ${header})
  endif()
endforeach()
set(azulejo_public_headers)
while(unread)
  list(POP_FRONT unread header)
  list(APPEND azulejo_public_headers ${header})
  file(STRINGS src/${header} includes REGEX "^#include ")
  foreach(line IN LISTS includes)
    if(line MATCHES "^#include \"(azulejo/.*)\"")
      if(NOT CMAKE_MATCH_1 IN_LIST azulejo_public_headers AND NOT CMAKE_MATCH_1 IN_LIST unread)
        list(APPEND unread ${CMAKE_MATCH_1})
      endif()
    elseif(NOT line MATCHES "^#include <([a-z_0-9]+|glm/.*)>")
      message(FATAL_ERROR "src/${header}: a public header may include azulejo, the standard library and GLM: ${line}")
    endif()
  endforeach()
endwhile()
list(TRANSFORM azulejo_public_headers PREPEND ${PROJECT_SOURCE_DIR}/src/)

target_sources(azulejo PUBLIC FILE_SET HEADERS BASE_DIRS src FILES ${azulejo_public_headers})
set_target_properties(azulejo_command PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
install(TARGETS azulejo EXPORT azulejo FILE_SET HEADERS)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/azulejo)
install(EXPORT azulejo NAMESPACE azulejo:: FILE azulejoConfig.cmake DESTINATION ${package})
write_basic_package_version_file(azulejoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/azulejoConfigVersion.cmake DESTINATION ${package})

# A program outside the tree is built against what was installed, and run.
if(AZULEJO_TESTS AND NOT AZULEJO_SANITIZE AND NOT AZULEJO_COVERAGE)
  add_test(NAME install_consumer COMMAND ${CMAKE_COMMAND}
    -DBUILD=${PROJECT_BINARY_DIR} -DCONSUMER=${PROJECT_SOURCE_DIR}/examples/consumer
    -DGENERATOR=${CMAKE_GENERATOR} -DCOMPILER=${CMAKE_CXX_COMPILER}
    -P ${PROJECT_SOURCE_DIR}/cmake/install_consumer.cmake)
endif()
