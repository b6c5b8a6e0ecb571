# Every struct of the header has its size in layout.c, and every member its offset.
#
#     cmake -D HEADER=include/taut.h -D LAYOUT=cpp_tests/layout.c -P layout.cmake
file(READ ${HEADER} header)
file(READ ${LAYOUT} layout)
string(REPLACE ";" "," header "${header}") # else CMake takes it for a list
string(REGEX REPLACE "/\\*[^*]*\\*+([^/*][^*]*\\*+)*/" "" header "${header}")

set(forgotten "")
string(REGEX MATCHALL "typedef struct {[^}]*} [a-z_]+" structs "${header}")
foreach(struct IN LISTS structs)
    string(REGEX REPLACE ".*} " "" name "${struct}")
    if(NOT layout MATCHES "\nSIZE\\(${name}, ")
        list(APPEND forgotten "${name}")
    endif()
    string(REGEX MATCHALL "[a-z_0-9]+," members "${struct}")
    foreach(member IN LISTS members)
        if(NOT layout MATCHES "\nFIELD\\(${name}, ${member} ")
            list(APPEND forgotten "${name}.${member}")
        endif()
    endforeach()
    list(LENGTH members count)
    message("${name}: ${count} members")
endforeach()
if(NOT structs OR forgotten)
    message(FATAL_ERROR "not in ${LAYOUT}: ${forgotten}")
endif()
