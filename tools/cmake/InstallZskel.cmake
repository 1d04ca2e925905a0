# zskel_install(TARGET PRIVATE_HEADERS...): the library, its headers but the private ones under include/zskel/, and
# a package that find_package(zskel) finds and that gives zskel::zskel.
include(CMakePackageConfigHelpers)

function(zskel_install target)
    set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/zskel)
    install(TARGETS ${target} EXPORT zskelTargets)
    install(EXPORT zskelTargets NAMESPACE zskel:: DESTINATION ${folder})
    set(private)
    foreach(header IN LISTS ARGN)
        list(APPEND private PATTERN ${header} EXCLUDE)
    endforeach()
    install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/zskel TYPE INCLUDE FILES_MATCHING PATTERN "*.h" ${private})
    configure_package_config_file(
        ${PROJECT_SOURCE_DIR}/tools/cmake/zskelConfig.cmake.in zskelConfig.cmake INSTALL_DESTINATION ${folder})
    write_basic_package_version_file(zskelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/zskelConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/zskelConfigVersion.cmake
        DESTINATION ${folder})
endfunction()
