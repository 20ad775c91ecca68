// Control points as bytes: multiples of a quantum, or 32-bit floats (docs/formats.md).
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/field/unknowns.h"

namespace cleft {

/// 32-bit floats as four planes of bytes, the least significant first, which compresses better.
void append_planes(std::vector<std::uint8_t>& bytes, std::span<const float> numbers);
/// The floats in the last bytes, which are removed.
std::vector<float> take_planes(std::span<const std::uint8_t>& bytes, std::size_t count);

/// Slices of t that are stored, and their code.
struct CodedPoints {
  int slices = 0;
  std::vector<std::uint8_t> bytes;
};
/// Codes control points that follow from unknowns, which are multiples of `quantum`; anything else is a bug.
CodedPoints coded_points(std::span<const Vec3> points, const ControlTies& ties,
                         const std::array<BSplineBasis, 4>& bases, double quantum);
/// The last `count` bytes, which are removed. Throws InputError if there are fewer.
std::span<const std::uint8_t> take_bytes(std::span<const std::uint8_t>& bytes, std::size_t count);

/// The contents of a field besides its displacement: further quantities, and derivatives by parameters.
struct FieldExtras {
  std::vector<Quantity> quantities;
  std::vector<ParameterDerivative> by_parameter;
};
/// Adds them to the header, and their bytes after those of the displacement.
void append_extras(nlohmann::ordered_json& header, std::vector<std::uint8_t>& bytes, const Field& field);
/// Removes their bytes from the end. Throws InputError or a JSON error if they are damaged.
FieldExtras take_extras(const nlohmann::ordered_json& header, std::span<const std::uint8_t>& bytes,
                        const std::array<BSplineBasis, 4>& bases);

}  // namespace cleft
