# Tests of the shaders, the pipeline and one scenario with Mesa drivers other than llvmpipe. Part of
# `./run`.

driverPackages() {
    cat <<'EOF'
mesa-vulkan-drivers     lavapipe, on which zink draws
vulkan-validationlayers checks what zink asks of it
EOF
}

# Prints the complaints of Vulkan's validation layer in a log; fails when there are none.
complaints() {
    grep -E 'Validation (Error|Warning|Performance)' "$1" | sort | uniq -c | cut -c 1-400
}

# Arguments: the driver, then options of ctest. Runs tests with the label "driver": those that draw
# with GL and whose display does not read pixels into a buffer. For such reads Mesa 22.3 draws into
# a framebuffer without attachments, for which zink does not call vkCmdSetColorBlendEnableEXT; the
# layer reports that as an error.
testDriver() {
    local driver=$1 icd log=.build/host/Testing/Temporary/LastTest.log label=driver said
    shift
    ensurePackages buildPackages driverPackages
    build host mfard mfar-sim mfarctl mfar_faulty_gl mfar_pretended_v4l2 mfar-shader-tests-egl \
        mfar-engine-tests-egl mfar-warp-tests-egl mfar-lost-context-tests
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
    *) die "--driver needs zink or softpipe" ;;
    esac
    ctest --test-dir .build/host --parallel "$((jobs + 1))" --output-on-failure \
        --timeout 120 --label-regex "^$label\$" "$@"
    [[ $driver == zink ]] || return 0
    grep -q 'createinstance-status-message' "$log" ||
        die "Vulkan's validation layer has checked nothing, see $log"
    said=$(complaints "$log") || return 0
    say "Vulkan's validation layer complains:"
    say "$said"
    return 1
}
