#include "explorer/scene/color_maps.h"

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

/// Of 0xRRGGBB.
std::vector<std::array<double, 3>> colors_of(const std::vector<unsigned>& codes) {
  constexpr double full = 255;
  std::vector<std::array<double, 3>> colors;
  for (const unsigned code : codes)
    colors.push_back({(code >> 16 & 0xff) / full, (code >> 8 & 0xff) / full, (code & 0xff) / full});
  return colors;
}

}  // namespace

/// viridis, magma: Smith and van der Walt (matplotlib). cividis: Nunez, Anderton and Renslow. vik: Crameri.
const std::vector<ColorMap>& color_maps() {
  static const std::vector<ColorMap> all{
      {"warm", "skin tone, then warm to dark", false,
       colors_of({0xedd4bf, 0xe6a880, 0xc77070, 0x8a4273, 0x3d1f61})},
      {"viridis", "dark blue, green, yellow", false,
       colors_of({0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c, 0x28ae80, 0x5ec962, 0xaddc30, 0xfde725})},
      {"cividis", "blue to yellow, the same to colour-blind eyes", false,
       colors_of({0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173, 0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b,
                  0xffea46})},
      {"magma", "black, violet, pale yellow", false,
       colors_of({0x000004, 0x180f3e, 0x451077, 0x721f81, 0x9f2f7f, 0xcd4071, 0xf1605d, 0xfd9567, 0xfec98d,
                  0xfcfdbf})},
      {"grey", "white to black, for print", false, colors_of({0xf4f4f4, 0x101010})},
      {"vik", "blue below the middle, brown above", true,
       colors_of({0x001261, 0x033e7d, 0x1e6f9d, 0x71a8c4, 0xc9dde7, 0xece5e0, 0xeacebd, 0xd39774, 0xbe6533,
                  0x8b2706, 0x590008})}};
  return all;
}

const ColorMap& color_map(const std::string& name) {
  std::vector<std::string> names;
  for (const ColorMap& map : color_maps()) {
    if (map.name == name) return map;
    names.push_back(map.name);
  }
  throw InputError("'" + name + "' is no colour map" + did_you_mean(name, names) + "; there are " +
                   color_map_names() + ", and auto");
}

std::string color_map_names() {
  std::string names;
  for (const ColorMap& map : color_maps()) names += (names.empty() ? "" : "|") + map.name;
  return names;
}

}  // namespace cleft
