# Registers the tests of a program whose start (OpenGL contexts, shaders to compile) takes longer
# than one of its tests. A few processes run all tests.
#   target       the program
#   name         name of the tests; a number follows it
#   SHARDS       number of processes (default: 4)
#   FILTER       filter of GoogleTest
#   LABELS       labels of CTest
#   COST         duration of a process [s] (default: 10)
#   ENVIRONMENT  variables, as NAME=VALUE
# LABELS and ENVIRONMENT may be empty. Without this policy, CMake 3.31 warns about empty values.
if(POLICY CMP0174)
    cmake_policy(SET CMP0174 NEW)
endif()

function(mfar_add_sharded_tests target name)
    cmake_parse_arguments(PARSE_ARGV 2 arg "" "SHARDS;FILTER;LABELS;COST" "ENVIRONMENT")
    if(NOT arg_SHARDS)
        set(arg_SHARDS 4)
    endif()
    if(NOT arg_COST)
        set(arg_COST 10)
    endif()
    if(NOT arg_FILTER)
        set(arg_FILTER *)
    endif()
    if(CMAKE_CROSSCOMPILING)
        set(properties)
        foreach(property LABELS ENVIRONMENT)
            if(arg_${property})
                # A property's value must be one argument, even if it sets several variables.
                string(REPLACE ";" "\\;" value "${arg_${property}}")
                list(APPEND properties ${property} "${value}")
            endif()
        endforeach()
        gtest_discover_tests(${target} TEST_LIST ${name} TEST_FILTER ${arg_FILTER}
                             PROPERTIES ${properties})
        return()
    endif()
    math(EXPR last "${arg_SHARDS} - 1")
    foreach(shard RANGE ${last})
        add_test(NAME ${name}-${shard} COMMAND ${target} --gtest_filter=${arg_FILTER})
        set_tests_properties(${name}-${shard} PROPERTIES
            ENVIRONMENT "GTEST_TOTAL_SHARDS=${arg_SHARDS};GTEST_SHARD_INDEX=${shard};${arg_ENVIRONMENT}"
            LABELS "${arg_LABELS}" COST ${arg_COST} FAIL_REGULAR_EXPRESSION "Running 0 tests from")
    endforeach()
endfunction()
