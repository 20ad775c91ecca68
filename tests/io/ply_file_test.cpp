// The reader of .ply: numbers of every type and form, and files of any bytes.
#include "explorer/io/ply_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

enum class Form { text, little, big };

/// A number in the file's form. T is the type that the header names.
template <class T>
std::string number(Form form, T value) {
  if (form == Form::text) {
    std::ostringstream out;
    out.precision(17);
    out << +value << ' ';
    return out.str();
  }
  std::string bytes(sizeof value, 0);
  std::memcpy(bytes.data(), &value, sizeof value);
  if (form == Form::big) std::reverse(bytes.begin(), bytes.end());  // tests run on little-endian machines
  return bytes;
}

std::string line_end(Form form) { return form == Form::text ? "\n" : ""; }

const char* name_of(Form form) {
  return form == Form::text ? "ascii" : form == Form::little ? "binary_little_endian" : "binary_big_endian";
}

/// Two faces on five points, between elements and properties that the reader has to skip.
std::string house(Form form) {
  std::string text = std::string("ply\r\nformat ") + name_of(form) +
                     " 1.0\ncomment zipper x 1 y 2 z 3\nobj_info element vertex 7\nelement vertex 5\n"
                     "property uchar red\nproperty double x\nproperty float32 y\nproperty short z\n"
                     "property list uint8 double weights\nelement material 2\nproperty int8 kind\n"
                     "property uint code\nelement nothing 3\nelement face 2\nproperty ushort group\n"
                     "property list uint16 int32 vertex_indices\nproperty list char float texcoord\n"
                     "end_header\n";
  const double points[5][3] = {{0, 0, 0}, {1e9 + 0.125, 0, -3}, {2, 2.5, 0}, {-1, 2, 32767}, {1, 4, -32768}};
  for (int i = 0; i < 5; ++i) {
    text += number<std::uint8_t>(form, 200) + number<double>(form, points[i][0]) +
            number<float>(form, static_cast<float>(points[i][1])) +
            number<std::int16_t>(form, static_cast<std::int16_t>(points[i][2])) +
            number<std::uint8_t>(form, static_cast<std::uint8_t>(i));
    for (int k = 0; k < i; ++k) text += number<double>(form, k);
    text += line_end(form);
  }
  for (int i = 0; i < 2; ++i)
    text += number<std::int8_t>(form, -1) + number<std::uint32_t>(form, 4294967295u) + line_end(form);
  for (const std::vector<int>& face : {std::vector{0, 1, 2, 3}, {3, 2, 4}}) {
    text += number<std::uint16_t>(form, 65535) +
            number<std::uint16_t>(form, static_cast<std::uint16_t>(face.size()));
    for (const int corner : face) text += number<std::int32_t>(form, corner);
    text += number<std::int8_t>(form, 1) + number<float>(form, 0.5f) + line_end(form);
  }
  return text;
}

class PlyFile : public ::testing::TestWithParam<Form> {
 protected:
  MeshPolygons read(const std::string& bytes) const { return read_ply(in.write("a.ply", bytes)); }
  /// What is said of a file that is refused; "" if it is read.
  std::string refusal(const std::string& bytes) const {
    try {
      read(bytes);
      return "";
    } catch (const FileError& error) {
      return error.what();
    }
  }
  const TemporaryFolder in;
};

std::string with(std::string text, const std::string& what, const std::string& instead) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), instead);
}

TEST_P(PlyFile, ReadsEveryTypeAndSkipsTheRest) {
  const MeshPolygons ply = read(house(GetParam()));
  ASSERT_EQ(ply.points.size(), 5u);
  EXPECT_EQ(ply.points[1], (Vec3{1e9 + 0.125, 0, -3}));
  EXPECT_EQ(ply.points[3], (Vec3{-1, 2, 32767}));
  EXPECT_EQ(ply.points[4], (Vec3{1, 4, -32768}));
  EXPECT_EQ(ply.polygons, (std::vector<std::vector<int>>{{0, 1, 2, 3}, {3, 2, 4}}));
}

TEST_P(PlyFile, SaysWhatIsWrongAndWhere) {
  const std::string good = house(GetParam());
  const auto expect = [&](const std::string& what, const std::string& instead, const std::string& told) {
    const std::string said = refusal(with(good, what, instead));
    EXPECT_NE(said.find(told), std::string::npos) << instead << ": " << said;
  };
  expect("element vertex 5", "element vertex 999999999999", "ends before");
  expect("element vertex 5", "element vertex -5", "line 5");
  expect("element vertex 5", "element vertex 9999999999999", "line 5");
  expect("element face 2", "element face 3", "ends before");
  expect("property uchar red", "property uchar16 red", "line 6");
  expect("list uint16 int32", "list float int32", "line 17");
  expect("end_header", "end_headed", "end_headed");
  expect("format ", "forma ", "line 2");
  expect("int32 vertex_indices", "int32 corners", "vertex_indices");
  EXPECT_NE(refusal(good.substr(0, good.size() - 9)).find("ends before"), std::string::npos);
}

TEST_P(PlyFile, IndicesAreThoseOfPoints) {
  std::string text = std::string("ply\nformat ") + name_of(GetParam()) +
                     " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 9; ++i)
    text += number<float>(GetParam(), static_cast<float>(i * i)) + line_end(GetParam());
  text += number<std::uint8_t>(GetParam(), 3);
  for (int i = 0; i < 2; ++i) text += number<std::int32_t>(GetParam(), i);
  EXPECT_EQ(refusal(text + number<std::int32_t>(GetParam(), 2)), "");
  for (const std::int32_t corner : {3, -1, 2147483647, -2147483647})
    EXPECT_NE(refusal(text + number<std::int32_t>(GetParam(), corner)).find("names point"),
              std::string::npos);
}

/// A byte, a few bytes, a piece or a number of the header is other than it was, or missing.
std::string mutated(std::string bytes, std::mt19937& random) {
  const auto any = [&](std::size_t n) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(1, n));
  };
  for (std::size_t changes = 1 + any(3); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = any(bytes.size());
    switch (any(6)) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.erase(at, 1 + any(20));
        break;
      case 2:
        bytes.insert(at, bytes.substr(any(bytes.size()), any(40)));
        break;
      case 3:
        bytes.resize(at);
        break;
      case 4:
        bytes[at] = "09-.\n e\xff"[any(8)];
        break;
      default: {
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        if (digit != std::string::npos)
          bytes.replace(digit, 1,
                        std::vector<std::string>{"0", "-1", "255", "65536", "4294967295", "999999999999",
                                                 "1e400", "nan"}[any(8)]);
      }
    }
  }
  return bytes;
}

TEST_P(PlyFile, OfAnyBytesIsReadOrRefusedInBoundedMemory) {
  const std::string good = house(GetParam());
  std::mt19937 random(1);
  int refused = 0;
  for (int n = 0; n < 2000; ++n) {
    const std::string bytes = mutated(good, random);
    try {
      const MeshPolygons ply = read(bytes);
      EXPECT_LE(ply.points.size() + ply.polygons.size(), bytes.size());
      for (const std::vector<int>& polygon : ply.polygons)
        for (const int corner : polygon) ASSERT_LT(static_cast<std::size_t>(corner), ply.points.size());
    } catch (const FileError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
  EXPECT_LT(refused, 1950);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 500 * 1024) << "kB: counts are compared with the file before memory is taken";
}

INSTANTIATE_TEST_SUITE_P(Forms, PlyFile, ::testing::Values(Form::text, Form::little, Form::big));

}  // namespace
}  // namespace cleft
