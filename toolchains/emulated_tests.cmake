# Under an emulator the start of a program takes seconds: what is one test each elsewhere is one per
# program here. Those that are worth their time in an emulator have the label "emulated".
set(mfar_emulated
    mfar-composite-tests
    mfar-daemon-tests
    mfar-depth-tests
    mfar-flow-tests
    mfar-shader-tests-egl
    mfar-track-tests
    mfar-unit-tests
)

function(gtest_discover_tests target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "TEST_FILTER" "")
    add_test(NAME ${target} COMMAND ${target} --gtest_filter=${arg_TEST_FILTER})
    if(target IN_LIST mfar_emulated)
        set_tests_properties(${target} PROPERTIES LABELS emulated TIMEOUT 1200)
    endif()
endfunction()
