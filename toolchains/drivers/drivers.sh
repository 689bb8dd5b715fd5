# Tests of the shaders, the pipeline and one scenario with Mesa drivers other than llvmpipe. Part of
# `./run`.

driverPackages() {
    cat <<'EOF'
mesa-vulkan-drivers     lavapipe, on which zink draws
vulkan-validationlayers checks zink's calls of Vulkan
EOF
}

# complaints LOG: prints the messages of Vulkan's validation layer in a log. Fails if there are
# none.
complaints() {
    grep -E 'Validation (Error|Warning|Performance)' "$1" | sort | uniq -c | cut -c 1-400
}

# testDriver DRIVER [CTEST-OPTION...]: runs tests on this Mesa driver: on zink those with the label
# "driver", on softpipe those with the label "softpipe". The label "driver" is for tests that draw
# with GL. Tests in which mfard reads pixels into a buffer object for a display lack this label,
# because they would fail on zink: for such reads, Mesa 22.3 draws into a framebuffer without
# attachments. With this framebuffer, zink omits the call vkCmdSetColorBlendEnableEXT, and the
# validation layer reports this as an error.
testDriver() {
    local driver=$1 icd log=.build/host/Testing/Temporary/LastTest.log label=driver said
    shift
    ensurePackages buildPackages driverPackages
    build host mfard mfar-sim mfarctl mfar_faulty_gl mfar_pretended_v4l2 mfar-shader-tests-egl \
        mfar-engine-tests-egl mfar-warp-tests-egl mfar-lost-context-tests mfar-even-last-row
    export LIBGL_ALWAYS_SOFTWARE=1 MFAR_GL_DEVICE=software GALLIUM_DRIVER=$driver
    export XDG_RUNTIME_DIR=${XDG_RUNTIME_DIR:-/tmp} # Vulkan's loader needs one
    case $driver in
    zink)
        icd=$(find /usr/share/vulkan/icd.d -name 'lvp_icd.*' | head -n 1)
        [[ -n $icd ]] || die "the driver lavapipe is missing in /usr/share/vulkan/icd.d"
        export VK_ICD_FILENAMES=$icd VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation
        export VK_LAYER_SETTINGS_PATH=$PWD/toolchains/drivers
        ;;
    softpipe) label=softpipe ;;
    *) die "test: --driver must be zink or softpipe, not '$driver'" ;;
    esac
    ctest --test-dir .build/host --parallel "$((jobs + 1))" --output-on-failure \
        --timeout 120 --label-regex "^$label\$" "$@"
    [[ $driver == zink ]] || return 0
    grep -q 'createinstance-status-message' "$log" ||
        die "Vulkan's validation layer was not active, see $log"
    said=$(complaints "$log") || return 0
    say "Vulkan's validation layer reports:"
    say "$said"
    return 1
}
