# zskel_embed(TARGET NAME FILES...): one generated header, "NAME_sources.h", holding each file as a std::string_view in
# namespace zskel::NAME, named after it (depth.vert -> kDepthVert); rebuilt when a file changes.

function(zskel_embed target name)
    set(header "${CMAKE_CURRENT_BINARY_DIR}/generated/${name}_sources.h")
    set(script "${PROJECT_SOURCE_DIR}/tools/cmake/write_embedded_header.cmake")
    list(JOIN ARGN "|" joined)
    add_custom_command(
        OUTPUT "${header}"
        COMMAND ${CMAKE_COMMAND} "-DOUT=${header}" "-DNAME=${name}" "-DFILES=${joined}" -P "${script}"
        DEPENDS ${ARGN} "${script}"
        COMMENT "Embedding ${name}"
        VERBATIM)
    target_sources(${target} PRIVATE "${header}")
    target_include_directories(${target} PRIVATE "${CMAKE_CURRENT_BINARY_DIR}/generated")
endfunction()
