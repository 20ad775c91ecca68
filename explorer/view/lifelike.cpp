#include "explorer/view/lifelike.h"

#include <vtkCamera.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include <string>

#include "explorer/view/surface_part.h"

namespace cleft {

namespace {

/// Colours are multiplied by light in their squares, which is near to linear.
constexpr const char* begin = R"(
  vec3 N = normalize(normalVCVSOutput), V = normalize(-vertexVC.xyz);
  float edge = 1.0 - max(dot(N, V), 0.0);
  vec3 albedo = (ambientColor + diffuseColor) * (ambientColor + diffuseColor);
  float shade = 1.0;
  if (scalpelRadius > 0.0) {
    vec3 from = vertexVC.xyz - scalpelTip;
    float along = clamp(dot(from, scalpelAxis), 0.0, 80.0);
    vec3 way = scalpelAxis * along - from;
    float far = max(length(way), 1e-3), radius = scalpelRadius * smoothstep(-2.0, 14.0, along);
    shade -= 0.75 * clamp(0.3 + dot(N, way) / far, 0.0, 1.0) * min(radius * radius / (far * far), 1.0);
  }
  float open = lightVSOutput.x * shade;
  open *= open * (1.6 - 0.6 * open);
  vec3 opened = open / (1.0 - 0.4 * albedo * (1.0 - open));
  vec3 light = opened * mix(vec3(0.22, 0.14, 0.12), vec3(0.27, 0.235, 0.235), 0.5 + 0.5 * N.y);
  float shine = 0.0;
)";

/// WRAP: how far behind the border of its shade light goes, of red, green and blue.
constexpr const char* lamp = R"(
  {
    float c = dot(N, -lightDirectionVC#);
    vec3 bent = max((vec3(c) + WRAP) / (vec3(1.0) + WRAP), 0.0);
    bent *= (bent + 0.6) / 1.6;
    light += 0.76 * lightColor# * bent * mix(opened, vec3(shade), 0.3);
    float h = max(dot(N, normalize(V - lightDirectionVC#)), 0.0);
    shine += lightColor#.g * smoothstep(-0.05, 0.25, c) * (HIGHLIGHT);
  }
)";

constexpr const char* end = R"(
  gl_FragData[0] = vec4(sqrt(clamp(color, 0.0, 1.0)), opacity);
)";

void replace_all(std::string& in, const std::string& what, const std::string& with) {
  for (std::size_t at = in.find(what); at != std::string::npos; at = in.find(what, at + with.size()))
    in.replace(at, what.size(), with);
}

std::string light_code(const std::string& wrap, const std::string& highlight, const std::string& color) {
  std::string code = begin;
  for (const char* number : {"0", "1", "2"}) {  // of WoundView's lights
    std::string one = lamp;
    replace_all(one, "WRAP", wrap), replace_all(one, "HIGHLIGHT", highlight), replace_all(one, "#", number);
    code += one;
  }
  return code + color + end;
}

/// An even noise of a place, with its gradient: between the random values of a grid of size 1.
constexpr const char* noise = R"(
float at_corner(vec3 i) {
  i = fract(i * vec3(0.1031, 0.1030, 0.0973));
  i += dot(i, i.yzx + 33.33);
  return fract((i.x + i.y) * i.z);
}
vec4 grain(vec3 x) {
  vec3 i = floor(x), f = fract(x), u = f * f * (3.0 - 2.0 * f), du = 6.0 * f * (1.0 - f);
  float a = at_corner(i), b = at_corner(i + vec3(1, 0, 0)), c = at_corner(i + vec3(0, 1, 0)),
        d = at_corner(i + vec3(1, 1, 0)), e = at_corner(i + vec3(0, 0, 1)), g = at_corner(i + vec3(1, 0, 1)),
        h = at_corner(i + vec3(0, 1, 1)), j = at_corner(i + vec3(1, 1, 1));
  vec4 low = vec4(mix(a, b, u.x), mix(c, d, u.x), b - a, d - c),
       high = vec4(mix(e, g, u.x), mix(h, j, u.x), g - e, j - h);
  float p = mix(low.x, low.y, u.y), q = mix(high.x, high.y, u.y);
  return 2.0 * vec4(du * vec3(mix(mix(low.z, low.w, u.y), mix(high.z, high.w, u.y), u.z),
                              mix(low.y - low.x, high.y - high.x, u.z), q - p), mix(p, q, u.z) - 0.5);
}
)";

void take_code(vtkActor* actor, const std::string& light) {
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
  constexpr int points = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  mapper->MapDataArrayToVertexAttribute("lightMC", SurfacePart::light_array, points, -1);
  mapper->MapDataArrayToVertexAttribute("restMC", SurfacePart::rest_array, points, -1);
  vtkShaderProperty* shader = actor->GetShaderProperty();
  const std::string declared = "//VTK::Normal::Dec\n", done = "//VTK::Normal::Impl\n";
  shader->AddVertexShaderReplacement(
      declared, true,
      declared + "in vec2 lightMC;\nin vec3 restMC;\nout vec2 lightVSOutput;\nout vec3 restVSOutput;\n",
      false);
  shader->AddVertexShaderReplacement(done, true,
                                     done + "  lightVSOutput = lightMC;\n  restVSOutput = restMC;\n", false);
  shader->AddFragmentShaderReplacement(
      declared, true, declared + "in vec2 lightVSOutput;\nin vec3 restVSOutput;\n" + noise, false);
  shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true, light, false);
  actor->GetProperty()->SetAmbient(0);
  actor->GetProperty()->SetDiffuse(1);
  shade_under(actor, nullptr, nullptr);
}

}  // namespace

void light_as_skin(vtkActor* actor) {
  take_code(actor, "  float wet = 1.0 - smoothstep(0.0, 1.2, lightVSOutput.y);\n" +
                       light_code("vec3(0.50, 0.26, 0.20)",
                                  "0.045 * pow(h, 10.0) + 0.05 * pow(h, 36.0) + wet * 0.6 * pow(h, 90.0)", R"(
  albedo *= mix(vec3(1.0), vec3(0.72, 0.30, 0.26), 0.8 * wet);
  vec3 color = albedo * light + open * (shine + 0.05 * edge * edge * edge);
)"));
}

/// Its grain breaks the highlights; where it is finer than pixels it fades, and with it the single
/// highlights.
void light_as_wound(vtkActor* actor) {
  take_code(actor, R"(
  vec4 coarse = grain(1.1 * restVSOutput), fine = grain(3.1 * restVSOutput);
  vec3 widths = fwidth(restVSOutput);
  float grainy = 1.0 - smoothstep(0.15, 0.6, widths.x + widths.y + widths.z);
  diffuseColor *= 1.0 + grainy * (0.11 * coarse.w + 0.08 * fine.w);
  normalVCVSOutput = normalize(normalVCVSOutput + grainy * (0.12 * coarse.xyz + 0.06 * fine.xyz));
)" + light_code("vec3(0.30, 0.10, 0.08)", "0.05 * pow(h, 18.0) + (0.15 + 0.75 * grainy) * pow(h, 110.0)", R"(
  vec3 color = albedo * light + open * (shine + 0.10 * edge * edge * edge);
)"));
}

void light_as_steel(vtkActor* actor) {
  actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true, R"(
  vec3 N = normalize(normalVCVSOutput), V = normalize(-vertexVC.xyz);
  vec3 R = reflect(-V, N);
  float sky = smoothstep(-0.15, 0.35, R.y), lamp = smoothstep(0.82, 0.98, dot(R, normalize(vec3(-0.7, 0.9, 1.0))));
  float seen = mix(0.10, 0.62, sky) + 0.18 * smoothstep(0.75, 0.0, abs(R.y - 0.15)) + 0.9 * lamp;
  float edge = 1.0 - max(dot(N, V), 0.0);
  vec3 steel = (ambientColor + diffuseColor) * (0.16 + 0.84 * seen) + 0.25 * edge * edge * edge;
  gl_FragData[0] = vec4(clamp(steel, 0.0, 1.0), opacity);
)",
                                                           false);
  actor->GetProperty()->SetAmbient(0);
  actor->GetProperty()->SetDiffuse(1);
}

void shade_under(vtkActor* actor, vtkCamera* camera, const ScalpelPose* scalpel) {
  constexpr float radius = 5;  // mm, of a handle
  vtkUniforms* to = actor->GetShaderProperty()->GetFragmentCustomUniforms();
  float tip[3] = {}, axis[3] = {0, 0, 1};
  if (scalpel) {
    const vtkMatrix4x4* view = camera->GetModelViewTransformMatrix();
    for (int i = 0; i < 3; ++i) {
      tip[i] = static_cast<float>(view->GetElement(i, 3)), axis[i] = 0;
      for (int k = 0; k < 3; ++k) {
        tip[i] += static_cast<float>(view->GetElement(i, k) * scalpel->tip[k]);
        axis[i] += static_cast<float>(view->GetElement(i, k) * scalpel->axis[k]);
      }
    }
  }
  to->SetUniform3f("scalpelTip", tip);
  to->SetUniform3f("scalpelAxis", axis);
  to->SetUniformf("scalpelRadius", scalpel && scalpel->present ? radius : 0);
}

}  // namespace cleft
