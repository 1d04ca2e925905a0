# zskel_embed_glsl(TARGET FILES...): one generated header, "glsl_sources.h", holding each shader file as
# a std::string_view named after it (depth.vert -> kDepthVert); rebuilt when a shader changes.

function(zskel_embed_glsl target)
    set(header "${CMAKE_CURRENT_BINARY_DIR}/generated/glsl_sources.h")
    set(script "${PROJECT_SOURCE_DIR}/tools/cmake/write_glsl_header.cmake")
    list(JOIN ARGN "|" joined)
    add_custom_command(
        OUTPUT "${header}"
        COMMAND ${CMAKE_COMMAND} "-DOUT=${header}" "-DFILES=${joined}" -P "${script}"
        DEPENDS ${ARGN} "${script}"
        COMMENT "Embedding shaders"
        VERBATIM)
    target_sources(${target} PRIVATE "${header}")
    target_include_directories(${target} PRIVATE "${CMAKE_CURRENT_BINARY_DIR}/generated")
endfunction()
