// The OpenGL functions that the peer calls, as pointers: EGL alone is linked.
#pragma once

#include <GL/glcorearb.h>

namespace swell::apps {

// Member names are OpenGL's without the prefix: gl.Clear is glClear. The second name gives the
// pointer's type.
#define SWELL_GL_FUNCTIONS(X)                         \
  X(ActiveTexture, ACTIVETEXTURE)                     \
  X(AttachShader, ATTACHSHADER)                       \
  X(BindBuffer, BINDBUFFER)                           \
  X(BindFramebuffer, BINDFRAMEBUFFER)                 \
  X(BindTexture, BINDTEXTURE)                         \
  X(BindVertexArray, BINDVERTEXARRAY)                 \
  X(BufferData, BUFFERDATA)                           \
  X(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS)   \
  X(Clear, CLEAR)                                     \
  X(ClearColor, CLEARCOLOR)                           \
  X(ClearDepth, CLEARDEPTH)                           \
  X(ClipControl, CLIPCONTROL)                         \
  X(CompileShader, COMPILESHADER)                     \
  X(CreateProgram, CREATEPROGRAM)                     \
  X(CreateShader, CREATESHADER)                       \
  X(CullFace, CULLFACE)                               \
  X(DeleteShader, DELETESHADER)                       \
  X(DepthFunc, DEPTHFUNC)                             \
  X(Disable, DISABLE)                                 \
  X(DrawArrays, DRAWARRAYS)                           \
  X(DrawElements, DRAWELEMENTS)                       \
  X(Enable, ENABLE)                                   \
  X(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY) \
  X(Finish, FINISH)                                   \
  X(FramebufferTexture2D, FRAMEBUFFERTEXTURE2D)       \
  X(GenBuffers, GENBUFFERS)                           \
  X(GenFramebuffers, GENFRAMEBUFFERS)                 \
  X(GenTextures, GENTEXTURES)                         \
  X(GenVertexArrays, GENVERTEXARRAYS)                 \
  X(GetError, GETERROR)                               \
  X(GetProgramInfoLog, GETPROGRAMINFOLOG)             \
  X(GetProgramiv, GETPROGRAMIV)                       \
  X(GetShaderInfoLog, GETSHADERINFOLOG)               \
  X(GetShaderiv, GETSHADERIV)                         \
  X(GetString, GETSTRING)                             \
  X(GetUniformLocation, GETUNIFORMLOCATION)           \
  X(LinkProgram, LINKPROGRAM)                         \
  X(PixelStorei, PIXELSTOREI)                         \
  X(ReadPixels, READPIXELS)                           \
  X(ShaderSource, SHADERSOURCE)                       \
  X(StencilFunc, STENCILFUNC)                         \
  X(StencilOp, STENCILOP)                             \
  X(TexImage2D, TEXIMAGE2D)                           \
  X(TexParameteri, TEXPARAMETERI)                     \
  X(Uniform1f, UNIFORM1F)                             \
  X(Uniform1i, UNIFORM1I)                             \
  X(Uniform2f, UNIFORM2F)                             \
  X(Uniform3f, UNIFORM3F)                             \
  X(Uniform4fv, UNIFORM4FV)                           \
  X(UniformMatrix4fv, UNIFORMMATRIX4FV)               \
  X(UseProgram, USEPROGRAM)                           \
  X(VertexAttribPointer, VERTEXATTRIBPOINTER)         \
  X(Viewport, VIEWPORT)

struct Gl {
#define SWELL_GL_MEMBER(name, type) PFNGL##type##PROC name = nullptr;
  SWELL_GL_FUNCTIONS(SWELL_GL_MEMBER)
#undef SWELL_GL_MEMBER
};

}  // namespace swell::apps
