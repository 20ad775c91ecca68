// What is fuzzed: a reader is given any bytes. Anything but a result or an InputError is a finding.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cleft::fuzz {

/// Bytes as a path's CSV file; what can be read is asked for its frames.
void read_path(const std::uint8_t* data, std::size_t size);

/// The first byte chooses .glb (g), .gltf (t), or one of .obj, .stl, .ply and .vtp; the others are the file.
/// What can be read is cut once.
void read_and_cut_mesh(const std::uint8_t* data, std::size_t size);

/// The first byte chooses .frd or .xmf, the others are the file; what can be opened is read, frame by frame.
void read_series(const std::uint8_t* data, std::size_t size);

}  // namespace cleft::fuzz
