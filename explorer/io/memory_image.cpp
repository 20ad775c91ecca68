#include "explorer/io/memory_image.h"

#include <png.h>
#include <vtkJPEGReader.h>
#include <vtkLogger.h>
#include <vtkNew.h>

#include <array>
#include <optional>

#include "base/text.h"
#include "base/vtk_listener.h"

namespace cleft {

namespace {

double word(const std::string& bytes, std::size_t at, int length) {
  double value = 0;
  for (int i = 0; i < length; ++i)
    value = 256 * value + static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return value;
}

const std::string png = "\x89PNG\r\n\x1a\n", jpeg = "\xff\xd8\xff";

/// Width and height by the header, before memory is taken for them; none where there is no header.
std::optional<std::array<double, 2>> size_of_image(const std::string& bytes) {
  if (bytes.starts_with(png)) {
    if (bytes.size() < 24 || bytes.compare(12, 4, "IHDR") != 0) return std::nullopt;
    return {{word(bytes, 16, 4), word(bytes, 20, 4)}};
  }
  for (std::size_t at = 2; at + 9 < bytes.size();) {  // a JPEG's segments, until that of a frame
    if (bytes[at] != '\xff') return std::nullopt;
    const auto kind = static_cast<unsigned char>(bytes[at + 1]);
    const bool frame = kind >= 0xc0 && kind <= 0xcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
    if (frame) return {{word(bytes, at + 7, 2), word(bytes, at + 5, 2)}};
    at += 2 + static_cast<std::size_t>(word(bytes, at + 2, 2));
  }
  return std::nullopt;
}

/// By libpng itself: VTK's reader crashes on damaged files.
vtkSmartPointer<vtkImageData> decoded_png(const std::string& bytes, std::string& why) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
    return why = image.message, nullptr;
  image.format = PNG_FORMAT_RGBA;
  image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  auto pixels = vtkSmartPointer<vtkImageData>::New();
  pixels->SetDimensions(static_cast<int>(image.width), static_cast<int>(image.height), 1);
  pixels->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  const auto row = static_cast<png_int_32>(PNG_IMAGE_ROW_STRIDE(image));  // VTK's rows begin at the bottom
  if (png_image_finish_read(&image, nullptr, pixels->GetScalarPointer(), -row, nullptr) == 0)
    return why = image.message, nullptr;
  return pixels;
}

vtkSmartPointer<vtkImageData> decoded_jpeg(const std::string& bytes, std::string& why) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // its errors are reported by us
  vtkNew<vtkJPEGReader> reader;
  reader->SetMemoryBuffer(bytes.data());
  reader->SetMemoryBufferLength(static_cast<vtkIdType>(bytes.size()));
  const VtkListener reading(reader.Get());
  reader->Update();
  if (!reading.failed() && reader->GetOutput()->GetNumberOfPoints() > 0) return reader->GetOutput();
  why = reading.failed() ? reading.reason() : "it is empty";
  return nullptr;
}

}  // namespace

bool is_memory_image(const std::string& bytes) { return bytes.starts_with(png) || bytes.starts_with(jpeg); }

vtkSmartPointer<vtkImageData> memory_image(const std::string& bytes, std::string& why) {
  constexpr double most_of_a_byte = 4000;  // pixels, of an even image at its strongest compression
  const bool is_png = bytes.starts_with(png);
  if (!is_memory_image(bytes)) return why = "it is neither a .png nor a .jpg", nullptr;
  const auto size = size_of_image(bytes);
  if (!size) return why = "its header is damaged", nullptr;
  const double pixels = (*size)[0] * (*size)[1];
  if (!(pixels > 0 && pixels <= most_pixels && pixels <= most_of_a_byte * static_cast<double>(bytes.size())))
    return why = "it is said to have " + shortest((*size)[0]) + " x " + shortest((*size)[1]) + " pixels",
           nullptr;
  return is_png ? decoded_png(bytes, why) : decoded_jpeg(bytes, why);
}

}  // namespace cleft
