# The contract of the C interface: programs that share contract.c, built plainly, with sanitizers, and for valgrind.
#
#     ctest -L contract      as it is, 10 seconds
#     ctest -L sanitizer     addresses and undefined behaviour, in the library too; races, where TAUT_RACES is on
#     ctest -L valgrind
option(TAUT_SANITIZERS "Test with a second library that has Rust's AddressSanitizer, and in valgrind" OFF)
option(TAUT_RACES "Test with a third library that has Rust's ThreadSanitizer; needs the component rust-src" OFF)

set(contracts batch closest control curves errors exact heat mesh rows sources threads)

# taut_program(NAME LIBRARY SQUARES SOURCE... [OPTIONS OPTION...])
function(taut_program name library squares)
    cmake_parse_arguments(PARSE_ARGV 3 with "" "" "OPTIONS")
    add_executable(${name} ${with_UNPARSED_ARGUMENTS})
    set_target_properties(${name} PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF NO_SYSTEM_FROM_IMPORTED ON)
    target_compile_options(${name} PRIVATE ${strict} ${with_OPTIONS})
    target_link_options(${name} PRIVATE ${with_OPTIONS})
    target_compile_definitions(${name} PRIVATE TAUT_SQUARES=${squares}
        TAUT_RECTANGLE="${CMAKE_CURRENT_SOURCE_DIR}/rectangle.off" TAUT_SYMBOLS="${PROJECT_SOURCE_DIR}/include/taut.symbols")
    target_link_libraries(${name} PRIVATE ${library} m Threads::Threads)
endfunction()

# taut_contracts(SUFFIX LIBRARY SQUARES NAMES OPTION...): these programs.
function(taut_contracts suffix library squares names)
    foreach(name IN LISTS names)
        taut_program(contract_${name}${suffix} ${library} ${squares} contract_${name}.c contract.c functions.c ${ARGN})
    endforeach()
endfunction()

# A panic is expected; its backtrace takes valgrind half a minute.
function(taut_contract_tests suffix label names)
    foreach(name IN LISTS names)
        add_test(NAME contract_${name}${suffix} COMMAND ${ARGN} $<TARGET_FILE:contract_${name}${suffix}>)
        set_tests_properties(contract_${name}${suffix} PROPERTIES LABELS ${label} ENVIRONMENT RUST_BACKTRACE=0)
    endforeach()
endfunction()

# taut_proof(SUFFIX LABEL MISTAKE MESSAGE COMMAND...): the mistake is found, with this message.
function(taut_proof suffix label mistake message)
    add_test(NAME proof_${mistake}${suffix} COMMAND ${ARGN} $<TARGET_FILE:proof${suffix}> ${mistake})
    set_tests_properties(proof_${mistake}${suffix} PROPERTIES LABELS ${label} PASS_REGULAR_EXPRESSION "${message}")
endfunction()

taut_contracts("" taut::taut 300 "${contracts}")
taut_contract_tests("" contract "${contracts}")

# taut_sanitized_library(NAME FLAGS ARGUMENT...): the library once more, with a sanitizer of Rust's; gcc brings its runtime.
function(taut_sanitized_library name flags)
    execute_process(COMMAND rustc -vV OUTPUT_VARIABLE rustc COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCH "host: ([^\n]*)" host "${rustc}")
    set(folder ${PROJECT_BINARY_DIR}/${name}/${CMAKE_MATCH_1}/debug)
    add_custom_target(${name}_library
        COMMAND ${CMAKE_COMMAND} -E env RUSTC_BOOTSTRAP=1 RUSTFLAGS=${flags}
                ${TAUT_CARGO} rustc -p taut --lib --locked --crate-type cdylib
                --target ${CMAKE_MATCH_1} --target-dir ${PROJECT_BINARY_DIR}/${name} ${ARGN}
        COMMAND ${CMAKE_COMMAND} -E create_symlink ${shared_library} ${folder}/$<TARGET_SONAME_FILE_NAME:taut::taut>
        BYPRODUCTS ${folder}/${shared_library}
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
        USES_TERMINAL
        VERBATIM)
    add_library(taut::${name} SHARED IMPORTED)
    get_target_property(soname taut::taut IMPORTED_SONAME)
    set_target_properties(taut::${name} PROPERTIES
        IMPORTED_LOCATION ${folder}/${shared_library} IMPORTED_SONAME ${soname}
        INTERFACE_INCLUDE_DIRECTORIES ${PROJECT_SOURCE_DIR}/include)
    add_dependencies(taut::${name} ${name}_library)
endfunction()
set(shared_library ${CMAKE_SHARED_LIBRARY_PREFIX}taut${CMAKE_SHARED_LIBRARY_SUFFIX})

if(TAUT_SANITIZERS)
    taut_sanitized_library(asan -Zsanitizer=address)
    set(flags OPTIONS -g -fsanitize=address,undefined -fno-sanitize-recover=undefined)
    taut_contracts(_asan taut::asan 100 "${contracts}" ${flags})
    taut_program(proof_asan taut::asan 0 proof.c ${flags})
    taut_contract_tests(_asan sanitizer "${contracts}")
    taut_proof(_asan sanitizer overflow "heap-buffer-overflow.*WRITE of size 8.*taut_mesh_positions")
    taut_proof(_asan sanitizer use_after_free "heap-use-after-free.*READ of size 8.*taut_mesh_vertex_count")
    taut_proof(_asan sanitizer leak "LeakSanitizer: detected memory leaks.*taut_mesh_new")
    taut_proof(_asan sanitizer undefined "shift exponent 40 is too large")

    find_program(TAUT_VALGRIND valgrind REQUIRED)
    # Only "possibly" lost are the 48 bytes that Rust's standard library keeps about the main thread.
    set(valgrind ${TAUT_VALGRIND} -q --fair-sched=yes --error-exitcode=9 --leak-check=full
        --errors-for-leak-kinds=definite,indirect --show-leak-kinds=definite,indirect)
    taut_contracts(_valgrind taut::taut 50 "${contracts}" OPTIONS -g)
    taut_program(proof_valgrind taut::taut 0 proof.c OPTIONS -g)
    taut_contract_tests(_valgrind valgrind "${contracts}" ${valgrind})
    taut_proof(_valgrind valgrind overflow "Invalid write of size 8" ${valgrind})
    taut_proof(_valgrind valgrind use_after_free "Invalid read of size 8" ${valgrind})
    taut_proof(_valgrind valgrind leak "definitely lost" ${valgrind})
endif()

if(TAUT_RACES)
    taut_sanitized_library(tsan -Zsanitizer=thread -Zbuild-std)
    set(flags tsan.c OPTIONS -g -fsanitize=thread)
    taut_contracts(_tsan taut::tsan 50 "batch;control;rows;threads" ${flags})
    taut_contract_tests(_tsan sanitizer "batch;control;rows;threads")
    taut_program(proof_tsan taut::tsan 0 proof.c ${flags})
    taut_proof(_tsan sanitizer race "data race")
endif()
