# The shared library exports exactly the symbols of include/taut.symbols and has the soname that programs will look for.
execute_process(COMMAND ${NM} -D --defined-only ${LIBRARY} OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[0-9a-f]* [A-Za-z] ([^\n]*)" "\\1" exported "${listing}")
file(READ ${EXPECTED} expected)
if(NOT exported STREQUAL expected)
    message(FATAL_ERROR "${LIBRARY} exports\n${exported}but ${EXPECTED} lists\n${expected}")
endif()

execute_process(COMMAND ${READELF} -d ${LIBRARY} OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
if(NOT dynamic MATCHES "soname: \\[([^\n]*)\\]" OR NOT CMAKE_MATCH_1 STREQUAL SONAME)
    message(FATAL_ERROR "the soname is ${CMAKE_MATCH_1}, not ${SONAME}")
endif()
