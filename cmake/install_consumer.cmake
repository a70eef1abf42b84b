# The test install_consumer: installs BUILD into a fresh folder, builds CONSUMER against that, runs it.
set(folder ${BUILD}/install_consumer)
file(REMOVE_RECURSE ${folder})

function(step)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}: ${status}\n${output}")
  endif()
endfunction()

step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${folder}/prefix)
step(${CMAKE_COMMAND} -S ${CONSUMER} -B ${folder}/build -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER}
  -DCMAKE_PREFIX_PATH=${folder}/prefix -DCMAKE_BUILD_TYPE=Release)
step(${CMAKE_COMMAND} --build ${folder}/build)
step(${folder}/build/consumer)
step(${folder}/build/ripple ${folder}/ripple.png)

# The installed headers compile with nothing else: all of them in one file.
file(GLOB_RECURSE headers RELATIVE ${folder}/prefix/include ${folder}/prefix/include/azulejo/*.h)
list(TRANSFORM headers REPLACE "(.+)" "#include <\\1>\n")
file(WRITE ${folder}/all_headers.cpp ${headers})
step(${COMPILER} -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I${folder}/prefix/include ${folder}/all_headers.cpp)
