// The numbers in a glTF 2.0 file: the container (.glb, or .gltf with its buffers), and accessors, checked
// before anything is read. Private to this folder.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace cleft {

class GltfData {
 public:
  /// Throws FileError, with the entry, where the file is not whole and consistent, needs an extension that is
  /// not read, or names a file that is not beside or below it.
  explicit GltfData(const std::string& path);

  const nlohmann::json& json() const { return json_; }
  [[noreturn]] void refuse(const std::string& what) const;

  /// Entry i of a list at the top, as "meshes"; its length.
  const nlohmann::json& entry(const char* list, std::size_t i) const;
  std::size_t count(const char* list) const;
  /// A natural number of an object; `otherwise` where it is absent. `where` is for messages: "mesh 3".
  std::size_t natural(const nlohmann::json& object, const char* name, const std::string& where,
                      std::size_t otherwise) const;
  std::size_t natural(const nlohmann::json& object, const char* name, const std::string& where) const;

  struct Numbers {
    std::size_t components = 1;
    std::vector<double> values;  ///< components of each element
    std::size_t size() const { return values.size() / components; }
  };
  /// The elements of an accessor; normalized integers become 0 to 1, or -1 to 1.
  Numbers numbers(std::size_t accessor) const;
  /// The bytes of an image, of a buffer or a file.
  std::string image(std::size_t i) const;

 private:
  void open_container(const std::string& bytes);
  void open_buffers(std::string binary);
  void check_extensions() const;
  std::string resource(const std::string& uri, const std::string& where) const;
  std::string_view view(std::size_t i) const;

  std::string path_;
  nlohmann::json json_;
  std::vector<std::string> buffers_;
};

}  // namespace cleft
