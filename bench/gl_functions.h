#pragma once

#include <EGL/egl.h>
#include <GL/glcorearb.h>

#include <string>

#include "azulejo/core/error.h"

namespace azulejo::bench {

/// A function of EGL or OpenGL, of whatever type it is assigned to. Throws Error(Unsupported) where there is none.
class FoundFunction {
 public:
  explicit FoundFunction(const char* name) : function_(eglGetProcAddress(name)) {
    if (function_ == nullptr) throw Error(Error::Unsupported, std::string("OpenGL has no ") + name);
  }
  template <class T>
  operator T() const {  // NOLINT(google-explicit-constructor): the type is told by what it is assigned to
    return reinterpret_cast<T>(function_);
  }

 private:
  __eglMustCastToProperFunctionPointerType function_;
};

/// The functions of OpenGL that the peer calls, by their names without gl. There is nothing to link.
struct GlFunctions {
  PFNGLATTACHSHADERPROC AttachShader = FoundFunction("glAttachShader");
  PFNGLBINDATTRIBLOCATIONPROC BindAttribLocation = FoundFunction("glBindAttribLocation");
  PFNGLBINDBUFFERPROC BindBuffer = FoundFunction("glBindBuffer");
  PFNGLBINDFRAMEBUFFERPROC BindFramebuffer = FoundFunction("glBindFramebuffer");
  PFNGLBINDRENDERBUFFERPROC BindRenderbuffer = FoundFunction("glBindRenderbuffer");
  PFNGLBINDVERTEXARRAYPROC BindVertexArray = FoundFunction("glBindVertexArray");
  PFNGLBLITFRAMEBUFFERPROC BlitFramebuffer = FoundFunction("glBlitFramebuffer");
  PFNGLBUFFERDATAPROC BufferData = FoundFunction("glBufferData");
  PFNGLCHECKFRAMEBUFFERSTATUSPROC CheckFramebufferStatus = FoundFunction("glCheckFramebufferStatus");
  PFNGLCLEARBUFFERFVPROC ClearBufferfv = FoundFunction("glClearBufferfv");
  PFNGLCLIPCONTROLPROC ClipControl = FoundFunction("glClipControl");
  PFNGLCOMPILESHADERPROC CompileShader = FoundFunction("glCompileShader");
  PFNGLCREATEPROGRAMPROC CreateProgram = FoundFunction("glCreateProgram");
  PFNGLCREATESHADERPROC CreateShader = FoundFunction("glCreateShader");
  PFNGLDELETEFRAMEBUFFERSPROC DeleteFramebuffers = FoundFunction("glDeleteFramebuffers");
  PFNGLDELETEPROGRAMPROC DeleteProgram = FoundFunction("glDeleteProgram");
  PFNGLDELETERENDERBUFFERSPROC DeleteRenderbuffers = FoundFunction("glDeleteRenderbuffers");
  PFNGLDELETESHADERPROC DeleteShader = FoundFunction("glDeleteShader");
  PFNGLDEPTHFUNCPROC DepthFunc = FoundFunction("glDepthFunc");
  PFNGLDISABLEPROC Disable = FoundFunction("glDisable");
  PFNGLDRAWELEMENTSPROC DrawElements = FoundFunction("glDrawElements");
  PFNGLENABLEPROC Enable = FoundFunction("glEnable");
  PFNGLENABLEVERTEXATTRIBARRAYPROC EnableVertexAttribArray = FoundFunction("glEnableVertexAttribArray");
  PFNGLFINISHPROC Finish = FoundFunction("glFinish");
  PFNGLFRAMEBUFFERRENDERBUFFERPROC FramebufferRenderbuffer = FoundFunction("glFramebufferRenderbuffer");
  PFNGLGENBUFFERSPROC GenBuffers = FoundFunction("glGenBuffers");
  PFNGLGENFRAMEBUFFERSPROC GenFramebuffers = FoundFunction("glGenFramebuffers");
  PFNGLGENRENDERBUFFERSPROC GenRenderbuffers = FoundFunction("glGenRenderbuffers");
  PFNGLGENVERTEXARRAYSPROC GenVertexArrays = FoundFunction("glGenVertexArrays");
  PFNGLGETERRORPROC GetError = FoundFunction("glGetError");
  PFNGLGETPROGRAMIVPROC GetProgramiv = FoundFunction("glGetProgramiv");
  PFNGLGETPROGRAMINFOLOGPROC GetProgramInfoLog = FoundFunction("glGetProgramInfoLog");
  PFNGLGETSTRINGPROC GetString = FoundFunction("glGetString");
  PFNGLGETUNIFORMLOCATIONPROC GetUniformLocation = FoundFunction("glGetUniformLocation");
  PFNGLLINKPROGRAMPROC LinkProgram = FoundFunction("glLinkProgram");
  PFNGLPOLYGONMODEPROC PolygonMode = FoundFunction("glPolygonMode");
  PFNGLREADPIXELSPROC ReadPixels = FoundFunction("glReadPixels");
  PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC RenderbufferStorageMultisample =
      FoundFunction("glRenderbufferStorageMultisample");
  PFNGLSHADERSOURCEPROC ShaderSource = FoundFunction("glShaderSource");
  PFNGLUNIFORM1FPROC Uniform1f = FoundFunction("glUniform1f");
  PFNGLUNIFORM3FVPROC Uniform3fv = FoundFunction("glUniform3fv");
  PFNGLUNIFORMMATRIX4FVPROC UniformMatrix4fv = FoundFunction("glUniformMatrix4fv");
  PFNGLUSEPROGRAMPROC UseProgram = FoundFunction("glUseProgram");
  PFNGLVERTEXATTRIBPOINTERPROC VertexAttribPointer = FoundFunction("glVertexAttribPointer");
  PFNGLVIEWPORTPROC Viewport = FoundFunction("glViewport");
};

}  // namespace azulejo::bench
