# In an emulator, each start of a program takes seconds. So CTest runs all tests of a program in one
# process. The tests of these programs get the label "emulated"; `./run cross --test` runs them.
set(mfar_emulated
    mfar-composite-tests
    mfar-daemon-tests
    mfar-depth-tests
    mfar-display-tests
    mfar-engine-tests-egl
    mfar-flow-tests
    mfar-gl-library-tests
    mfar-libcamera-tests
    mfar-shader-tests-egl
    mfar-simd-tests
    mfar-track-tests
    mfar-trigger-tests
    mfar-unit-tests
    mfar-v4l2-tests
)

function(gtest_discover_tests target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "TEST_FILTER;TEST_LIST" "PROPERTIES")
    # The tests of some programs are registered in two parts. TEST_LIST is then the name of the part.
    set(name ${target})
    if(arg_TEST_LIST)
        set(name ${arg_TEST_LIST})
    endif()
    set(filter)
    if(target STREQUAL "mfar-engine-tests-egl")
        # Tests that use only shaders are skipped: for unknown reasons, llvmpipe on ARM has errors
        # of up to 1.83 grey levels in the still's luma (limit 1.5).
        set(arg_TEST_FILTER -*/gles)
    endif()
    if(arg_TEST_FILTER)
        set(filter --gtest_filter=${arg_TEST_FILTER})
    endif()
    add_test(NAME ${name} COMMAND ${target} ${filter})
    set_tests_properties(${name} PROPERTIES FAIL_REGULAR_EXPRESSION "Running 0 tests from"
                         ${arg_PROPERTIES})
    if(target IN_LIST mfar_emulated)
        set_tests_properties(${name} PROPERTIES LABELS emulated TIMEOUT 1200)
    endif()
endfunction()
