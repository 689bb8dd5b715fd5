# CPack runs this script after it has copied the files of the package. It adds the Debian packages
# of the programs' shared libraries to the package's dependencies.
file(GLOB programs ${CPACK_TEMPORARY_DIRECTORY}/usr/bin/*)
execute_process(
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/shlibdeps.sh "${CPACK_MFAR_SYSROOT}"
            ${CPACK_DEBIAN_PACKAGE_ARCHITECTURE} ${programs}
    OUTPUT_VARIABLE libraries OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "${libraries}, ${CPACK_DEBIAN_PACKAGE_DEPENDS}")
