#include "explorer/io/formats/mesh_formats.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/error.h"

namespace cleft {

namespace {

bool serves(const MeshFormat& format, MeshUse use) { return use == MeshUse::read || format.written; }

const MeshFormat* format_of(const std::string& path) {
  const std::string ending = ending_of(path);
  const auto found = std::find_if(std::begin(mesh_formats), std::end(mesh_formats),
                                  [&](const MeshFormat& format) { return format.ending == ending; });
  return found == std::end(mesh_formats) ? nullptr : found;
}

template <class Condition>
std::string list(const std::string& before_each, const Condition& holds) {
  std::string text;
  for (const MeshFormat& format : mesh_formats)
    if (holds(format)) text.append(text.empty() ? "" : " ").append(before_each).append(format.ending);
  return text;
}

}  // namespace

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool is_mesh(const std::string& path, MeshKind kind) {
  const MeshFormat* format = format_of(path);
  return format && format->kind == kind;
}

const MeshFormat& surface_format(const std::string& path, MeshUse use) {
  const MeshFormat* format = format_of(path);
  if (format && format->kind == MeshKind::surface && serves(*format, use)) return *format;
  throw InputError(path + ": unknown ending '" + ending_of(path) + "' of a mesh" +
                   (use == MeshUse::write ? " to write" : "") + "; known are " +
                   mesh_endings(MeshKind::surface, use));
}

std::string mesh_endings(MeshKind kind, MeshUse use) {
  return list("", [&](const MeshFormat& format) { return format.kind == kind && serves(format, use); });
}

std::string mesh_endings_with_arrays() {
  return list("", [](const MeshFormat& format) { return format.written && format.keeps_arrays; });
}

std::string surface_filter(MeshUse use) {
  const std::string patterns = list(
      "*", [&](const MeshFormat& format) { return format.kind == MeshKind::surface && serves(format, use); });
  return "Surface meshes (" + patterns + ")";
}

}  // namespace cleft
