#pragma once

// Private to gl/, the GL raster source and the pictures. Entry points come through the context's
// own loader, so that EGL and OSMesa contexts can live side by side in one process.
#include <GL/glcorearb.h>

namespace zskel::gl {

#define ZSKEL_GL_FUNCTIONS(X)                                            \
    X(PFNGLATTACHSHADERPROC, AttachShader)                               \
    X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                           \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                         \
    X(PFNGLBINDTEXTUREUNITPROC, BindTextureUnit)                         \
    X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                         \
    X(PFNGLBLENDFUNCPROC, BlendFunc)                                     \
    X(PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                     \
    X(PFNGLBLITNAMEDFRAMEBUFFERPROC, BlitNamedFramebuffer)               \
    X(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus) \
    X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)         \
    X(PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC, ClearNamedFramebufferuiv)       \
    X(PFNGLCLIENTWAITSYNCPROC, ClientWaitSync)                           \
    X(PFNGLCLIPCONTROLPROC, ClipControl)                                 \
    X(PFNGLCOLORMASKPROC, ColorMask)                                     \
    X(PFNGLCOMPILESHADERPROC, CompileShader)                             \
    X(PFNGLCREATEBUFFERSPROC, CreateBuffers)                             \
    X(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                   \
    X(PFNGLCREATEPROGRAMPROC, CreateProgram)                             \
    X(PFNGLCREATESHADERPROC, CreateShader)                               \
    X(PFNGLCREATETEXTURESPROC, CreateTextures)                           \
    X(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                   \
    X(PFNGLDEBUGMESSAGECALLBACKPROC, DebugMessageCallback)               \
    X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                             \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                   \
    X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                             \
    X(PFNGLDELETESHADERPROC, DeleteShader)                               \
    X(PFNGLDELETESYNCPROC, DeleteSync)                                   \
    X(PFNGLDELETETEXTURESPROC, DeleteTextures)                           \
    X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                   \
    X(PFNGLDEPTHFUNCPROC, DepthFunc)                                     \
    X(PFNGLDEPTHMASKPROC, DepthMask)                                     \
    X(PFNGLDISABLEPROC, Disable)                                         \
    X(PFNGLDISPATCHCOMPUTEPROC, DispatchCompute)                         \
    X(PFNGLDRAWARRAYSPROC, DrawArrays)                                   \
    X(PFNGLDRAWARRAYSINSTANCEDPROC, DrawArraysInstanced)                 \
    X(PFNGLDRAWELEMENTSPROC, DrawElements)                               \
    X(PFNGLDRAWELEMENTSINSTANCEDPROC, DrawElementsInstanced)             \
    X(PFNGLENABLEPROC, Enable)                                           \
    X(PFNGLENABLEVERTEXARRAYATTRIBPROC, EnableVertexArrayAttrib)         \
    X(PFNGLFENCESYNCPROC, FenceSync)                                     \
    X(PFNGLFINISHPROC, Finish)                                           \
    X(PFNGLGETERRORPROC, GetError)                                       \
    X(PFNGLGETGRAPHICSRESETSTATUSPROC, GetGraphicsResetStatus)           \
    X(PFNGLGETINTEGERVPROC, GetIntegerv)                                 \
    X(PFNGLGETNAMEDBUFFERSUBDATAPROC, GetNamedBufferSubData)             \
    X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                     \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                               \
    X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                       \
    X(PFNGLGETSHADERIVPROC, GetShaderiv)                                 \
    X(PFNGLGETSTRINGPROC, GetString)                                     \
    X(PFNGLGETSTRINGIPROC, GetStringi)                                   \
    X(PFNGLGETTEXTURESUBIMAGEPROC, GetTextureSubImage)                   \
    X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                   \
    X(PFNGLLINKPROGRAMPROC, LinkProgram)                                 \
    X(PFNGLMAPNAMEDBUFFERRANGEPROC, MapNamedBufferRange)                 \
    X(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                             \
    X(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)                   \
    X(PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData)                   \
    X(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERPROC, NamedFramebufferDrawBuffer)   \
    X(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERSPROC, NamedFramebufferDrawBuffers) \
    X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture)         \
    X(PFNGLPIXELSTOREIPROC, PixelStorei)                                 \
    X(PFNGLSHADERSOURCEPROC, ShaderSource)                               \
    X(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D)                       \
    X(PFNGLTEXTURESTORAGE2DMULTISAMPLEPROC, TextureStorage2DMultisample) \
    X(PFNGLTEXTURESTORAGE3DPROC, TextureStorage3D)                       \
    X(PFNGLUNIFORM1FPROC, Uniform1f)                                     \
    X(PFNGLUNIFORM1IPROC, Uniform1i)                                     \
    X(PFNGLUNIFORM1UIPROC, Uniform1ui)                                   \
    X(PFNGLUNIFORM2FPROC, Uniform2f)                                     \
    X(PFNGLUNIFORM3FPROC, Uniform3f)                                     \
    X(PFNGLUNIFORM4FPROC, Uniform4f)                                     \
    X(PFNGLUNIFORMMATRIX3FVPROC, UniformMatrix3fv)                       \
    X(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)                       \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                                   \
    X(PFNGLVERTEXARRAYATTRIBBINDINGPROC, VertexArrayAttribBinding)       \
    X(PFNGLVERTEXARRAYATTRIBFORMATPROC, VertexArrayAttribFormat)         \
    X(PFNGLVERTEXARRAYELEMENTBUFFERPROC, VertexArrayElementBuffer)       \
    X(PFNGLVERTEXARRAYVERTEXBUFFERPROC, VertexArrayVertexBuffer)         \
    X(PFNGLBINDBUFFERPROC, BindBuffer)                                   \
    X(PFNGLMULTIDRAWELEMENTSINDIRECTPROC, MultiDrawElementsIndirect)     \
    X(PFNGLVERTEXARRAYATTRIBIFORMATPROC, VertexArrayAttribIFormat)       \
    X(PFNGLVERTEXARRAYBINDINGDIVISORPROC, VertexArrayBindingDivisor)     \
    X(PFNGLVIEWPORTPROC, Viewport)

/// One context's entry points: `gl.DrawArrays(...)`.
struct Api {
#define ZSKEL_GL_MEMBER(type, name) type name = nullptr;
    ZSKEL_GL_FUNCTIONS(ZSKEL_GL_MEMBER)
#undef ZSKEL_GL_MEMBER
};

}  // namespace zskel::gl
