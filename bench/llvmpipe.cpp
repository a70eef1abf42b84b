#include "llvmpipe.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "azulejo/core/error.h"
#include "gl_functions.h"

namespace azulejo::bench {
namespace {

constexpr const char* kVertexShader = R"(#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 clip_from_world;
out vec3 surface_position;
out vec3 surface_normal;
void main() {
  surface_position = position;
  surface_normal = normal;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

constexpr const char* kFragmentShader = R"(
in vec3 surface_position;
in vec3 surface_normal;
uniform vec3 eye;
uniform vec3 toward_light[LIGHTS];
uniform vec3 light_color[LIGHTS];
uniform vec3 ambient;
uniform vec3 diffuse;
uniform vec3 specular;
uniform float shininess;
out vec4 color;
void main() {
  vec3 n = normalize(surface_normal);
  vec3 v = normalize(eye - surface_position);
  vec3 sum = ambient * diffuse;
  for (int i = 0; i < LIGHTS; ++i) {
    float lambert = dot(n, toward_light[i]);
    vec3 r = 2.0 * lambert * n - toward_light[i];
    float highlight = lambert > 0.0 ? pow(max(dot(r, v), 0.0), shininess) : 0.0;
    sum += light_color[i] * (diffuse * max(lambert, 0.0) + specular * highlight);
  }
  color = vec4(sum, 1.0);
}
)";

constexpr std::array<EGLint, 7> kOpenGl45{
    EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};

std::string failure(const char* what) {
  std::array<char, 16> code{};
  std::snprintf(code.data(), code.size(), "0x%04X", static_cast<unsigned>(eglGetError()));
  return std::string("llvmpipe: ") + what + " fails with " + code.data();
}

/// EGL has one display for each way to ask for one, and a display's threads are made when it starts: a second number
/// of threads in the same process needs a second way.
class Display {
 public:
  explicit Display(int threads) {
    const auto free = std::find(in_use_.begin(), in_use_.end(), false);
    if (free == in_use_.end()) throw Error(Error::Unsupported, "llvmpipe: only two may live at once");
    slot_ = static_cast<std::size_t>(free - in_use_.begin());
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
    handle_ = slot_ == 0 ? surfaceless() : software_device();
    if (handle_ == EGL_NO_DISPLAY || eglInitialize(handle_, nullptr, nullptr) == EGL_FALSE) {
      throw Error(Error::Unsupported, failure("starting EGL"));
    }
    in_use_[slot_] = true;
  }
  ~Display() {
    eglTerminate(handle_);
    in_use_[slot_] = false;
  }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  EGLDisplay handle() const { return handle_; }

 private:
  static EGLDisplay surfaceless() {
    return eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  }

  /// The device that stands for no hardware.
  static EGLDisplay software_device() {
    const PFNEGLQUERYDEVICESEXTPROC query_devices = FoundFunction("eglQueryDevicesEXT");
    const PFNEGLQUERYDEVICESTRINGEXTPROC query_string = FoundFunction("eglQueryDeviceStringEXT");
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count; ++i) {
      EGLDeviceEXT const device = devices[static_cast<std::size_t>(i)];
      const char* const extensions = query_string(device, EGL_EXTENSIONS);
      if (extensions == nullptr || std::string(extensions).find("EGL_MESA_device_software") == std::string::npos) {
        continue;
      }
      return eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    }
    return EGL_NO_DISPLAY;
  }

  static inline std::array<bool, 2> in_use_{};
  std::size_t slot_ = 0;
  EGLDisplay handle_ = EGL_NO_DISPLAY;
};

}  // namespace

class Llvmpipe::Context {
 public:
  explicit Context(int threads) : display_(threads) {
    eglBindAPI(EGL_OPENGL_API);
    context_ = eglCreateContext(display_.handle(), EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kOpenGl45.data());
    if (context_ == EGL_NO_CONTEXT) throw Error(Error::Unsupported, failure("making a context of OpenGL 4.5"));
    use();
    renderer_ = reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER));
    if (renderer_.find("llvmpipe") == std::string::npos) {
      throw Error(Error::Unsupported, "llvmpipe: OpenGL is drawn by " + renderer_);
    }
    const std::string version = reinterpret_cast<const char*>(gl_.GetString(GL_VERSION));  // "4.5 … Mesa 22.3.6"
    renderer_ = version.substr(std::min(version.size(), version.find("Mesa"))) + " " + renderer_;
    gl_.GenVertexArrays(1, &vertex_array_);
    gl_.BindVertexArray(vertex_array_);
    gl_.GenBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
    gl_.Enable(GL_CULL_FACE);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_GREATER);
    gl_.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  }

  ~Context() {
    eglMakeCurrent(display_.handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_.handle(), context_);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const std::string& renderer() const { return renderer_; }

  void load(const LlvmpipeModel& model) {
    use();
    std::vector<glm::vec3> vertices(model.positions.size() * 2);
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
      vertices[2 * i] = model.positions[i];
      vertices[2 * i + 1] = model.normals[i];
    }
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(glm::vec3)), vertices.data(),
                   GL_STATIC_DRAW);
    gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
    gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(model.corners.size_bytes()), model.corners.data(),
                   GL_STATIC_DRAW);
    for (GLuint attribute = 0; attribute < 2; ++attribute) {
      gl_.EnableVertexAttribArray(attribute);
      gl_.VertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, 2 * sizeof(glm::vec3),
                              reinterpret_cast<const void*>(attribute * sizeof(glm::vec3)));
    }
    corner_count_ = static_cast<GLsizei>(model.corners.size());
    check("loading a model");
  }

  void resize(const LlvmpipePicture& picture) {
    use();
    picture_ = picture;
    gl_.DeleteFramebuffers(2, framebuffers_.data());
    gl_.DeleteRenderbuffers(3, renderbuffers_.data());
    gl_.GenFramebuffers(2, framebuffers_.data());
    gl_.GenRenderbuffers(3, renderbuffers_.data());
    // Drawn into the first, with depth; several samples are resolved into the second.
    attach(framebuffers_[0], renderbuffers_[0], GL_COLOR_ATTACHMENT0, GL_RGBA8, picture.samples);
    attach(framebuffers_[0], renderbuffers_[1], GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, picture.samples);
    attach(framebuffers_[1], renderbuffers_[2], GL_COLOR_ATTACHMENT0, GL_RGBA8, 1);
    for (const GLuint framebuffer : framebuffers_) {
      gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
      if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw Error(Error::Unsupported, "llvmpipe: a picture of this size and number of samples can't be drawn");
      }
    }
    gl_.Viewport(0, 0, picture.width, picture.height);
    gl_.PolygonMode(GL_FRONT_AND_BACK, picture.lines ? GL_LINE : GL_FILL);
    picture.lines ? gl_.Disable(GL_CULL_FACE) : gl_.Enable(GL_CULL_FACE);
    check("making a picture");
  }

  void shade(const LlvmpipeShading& shading) {
    if (shading.lights.empty()) throw Error(Error::Argument, "llvmpipe: there is no light");
    use();
    gl_.DeleteProgram(program_);
    const std::string fragment = "#version 330 core\n#define LIGHTS " + std::to_string(shading.lights.size()) + "\n";
    program_ = link(kVertexShader, fragment + kFragmentShader);
    gl_.UseProgram(program_);
    std::vector<glm::vec3> toward;
    std::vector<glm::vec3> color;
    for (const LlvmpipeLight& light : shading.lights) {
      toward.push_back(light.toward);
      color.push_back(light.color);
    }
    set("toward_light", toward);
    set("light_color", color);
    set("ambient", std::span(&shading.ambient, 1));
    set("diffuse", std::span(&shading.diffuse, 1));
    set("specular", std::span(&shading.specular, 1));
    gl_.Uniform1f(gl_.GetUniformLocation(program_, "shininess"), shading.shininess);
    check("compiling the shaders");
  }

  void render(const glm::mat4& clip_from_world, const glm::vec3& eye) {
    use();
    gl_.UniformMatrix4fv(gl_.GetUniformLocation(program_, "clip_from_world"), 1, GL_FALSE, &clip_from_world[0][0]);
    set("eye", std::span(&eye, 1));
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[0]);
    constexpr std::array<GLfloat, 4> kTransparent{};
    constexpr GLfloat kFar = 0;
    gl_.ClearBufferfv(GL_COLOR, 0, kTransparent.data());
    gl_.ClearBufferfv(GL_DEPTH, 0, &kFar);
    gl_.DrawElements(GL_TRIANGLES, corner_count_, GL_UNSIGNED_INT, nullptr);
    if (picture_.samples > 1) {
      gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[1]);
      gl_.BlitFramebuffer(0, 0, picture_.width, picture_.height, 0, 0, picture_.width, picture_.height,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    gl_.Finish();
    check("drawing");
  }

  void read(std::span<std::byte> rgba) {
    use();
    const auto pixels = static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height);
    if (rgba.size() != 4 * pixels) throw Error(Error::Argument, "llvmpipe: the memory is not of the picture's size");
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[picture_.samples > 1 ? 1 : 0]);
    gl_.ReadPixels(0, 0, picture_.width, picture_.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    check("reading the picture");
  }

 private:
  void use() {
    if (eglGetCurrentContext() == context_) return;
    if (eglMakeCurrent(display_.handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      throw Error(Error::Unsupported, failure("using a context"));
    }
  }

  void check(const char* what) {
    if (gl_.GetError() != GL_NO_ERROR) throw Error(Error::Resource, std::string("llvmpipe: ") + what + " fails");
  }

  void attach(GLuint framebuffer, GLuint renderbuffer, GLenum place, GLenum format, int samples) {
    gl_.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
    gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, picture_.width,
                                       picture_.height);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, renderbuffer);
  }

  GLuint link(const std::string& vertex, const std::string& fragment) {
    const GLuint program = gl_.CreateProgram();
    for (const auto& [kind, text] : {std::pair(GL_VERTEX_SHADER, vertex), std::pair(GL_FRAGMENT_SHADER, fragment)}) {
      const GLuint shader = gl_.CreateShader(static_cast<GLenum>(kind));
      const char* const source = text.c_str();
      gl_.ShaderSource(shader, 1, &source, nullptr);
      gl_.CompileShader(shader);
      gl_.AttachShader(program, shader);
      gl_.DeleteShader(shader);  // when the program is
    }
    gl_.BindAttribLocation(program, 0, "position");
    gl_.BindAttribLocation(program, 1, "normal");
    gl_.LinkProgram(program);
    GLint linked = 0;
    gl_.GetProgramiv(program, GL_LINK_STATUS, &linked);
    std::array<GLchar, 512> log{};
    if (linked == 0) gl_.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    if (linked == 0) throw Error(Error::Unsupported, std::string("llvmpipe: shaders: ") + log.data());
    return program;
  }

  void set(const char* name, std::span<const glm::vec3> values) {
    gl_.Uniform3fv(gl_.GetUniformLocation(program_, name), static_cast<GLsizei>(values.size()), &values[0].x);
  }

  Display display_;
  EGLContext context_ = EGL_NO_CONTEXT;
  GlFunctions gl_;
  std::string renderer_;
  GLuint vertex_array_ = 0;
  std::array<GLuint, 2> buffers_{};  ///< vertices, corners
  std::array<GLuint, 2> framebuffers_{};
  std::array<GLuint, 3> renderbuffers_{};
  GLuint program_ = 0;
  GLsizei corner_count_ = 0;
  LlvmpipePicture picture_;
};

Llvmpipe::Llvmpipe(int threads) : context_(std::make_unique<Context>(threads)) {}
Llvmpipe::~Llvmpipe() = default;
const std::string& Llvmpipe::renderer() const { return context_->renderer(); }
void Llvmpipe::load(const LlvmpipeModel& model) { context_->load(model); }
void Llvmpipe::resize(const LlvmpipePicture& picture) { context_->resize(picture); }
void Llvmpipe::shade(const LlvmpipeShading& shading) { context_->shade(shading); }
void Llvmpipe::render(const glm::mat4& clip_from_world, const glm::vec3& eye) {
  context_->render(clip_from_world, eye);
}
void Llvmpipe::read(std::span<std::byte> rgba) { context_->read(rgba); }

}  // namespace azulejo::bench
