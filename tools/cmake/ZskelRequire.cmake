# find_package and find_path that name the Debian package to install when something is missing.

macro(zskel_require name apt)
    cmake_parse_arguments(_require "" "VERSION" "" ${ARGN})
    find_package(${name} ${_require_VERSION} QUIET)
    if(NOT ${name}_FOUND)
        message(FATAL_ERROR "zskel needs ${name}. On Debian: apt-get install ${apt} (or run tools/setup)")
    endif()
endmacro()

function(zskel_require_header header apt)
    string(MAKE_C_IDENTIFIER "ZSKEL_HEADER_${header}" variable)
    find_path(${variable} ${header})
    mark_as_advanced(${variable})
    if(NOT ${variable})
        message(FATAL_ERROR "zskel needs <${header}>. On Debian: apt-get install ${apt} (or run tools/setup)")
    endif()
endfunction()
