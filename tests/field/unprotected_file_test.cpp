// Files whose damage would go unseen, or whose content lies elsewhere, are not sound.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <fstream>
#include <functional>

#include "base/error.h"
#include "base/h5/h5.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

/// A file as Cleft writes it, to which `change` adds something.
class UnprotectedFile : public testing::Test {
 protected:
  std::string made(const std::function<void(hid_t file)>& change) {
    std::string path = place_ / "a.h5";
    h5::File file = h5::File::create(path, h5::Growth::none);
    const std::vector<double> numbers(100, 1.5);
    file.write<double>("/group/numbers", numbers, {numbers.size()});
    file.write_text("/", "units", "mm N MPa");
    file.close();
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    const hid_t opened = H5Fopen(path.c_str(), H5F_ACC_RDWR, access);
    change(opened);
    H5Fclose(opened), H5Pclose(access);
    return path;
  }
  /// A dataset of ten numbers, with what `layout` says of its creation.
  static void add(hid_t file, const std::function<void(hid_t creation)>& layout) {
    const hsize_t count = 10;
    const hid_t space = H5Screate_simple(1, &count, nullptr), creation = H5Pcreate(H5P_DATASET_CREATE);
    layout(creation);
    const hid_t data = H5Dcreate2(file, "more", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    const double numbers[10] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    ASSERT_GE(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers), 0);
    H5Dclose(data), H5Pclose(creation), H5Sclose(space);
  }
  static void expect_refused(const std::string& path, const std::string& part) {
    try {
      h5::File::open(path).read_everything();
      ADD_FAILURE() << "taken for sound: " << part;
    } catch (const FileError& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  }
  const TemporaryFolder place_;
};

TEST_F(UnprotectedFile, AsWrittenItIsSound) {
  EXPECT_NO_THROW(h5::File::open(made([](hid_t) {})).read_everything());
}

TEST_F(UnprotectedFile, DatasetsWithoutChecksums) {
  expect_refused(made([](hid_t file) { add(file, [](hid_t) {}); }), "/more has no checksum");
  const auto chunked = [](hid_t creation) {
    const hsize_t chunk = 5;
    H5Pset_chunk(creation, 1, &chunk), H5Pset_deflate(creation, 6);
  };
  expect_refused(made([&](hid_t file) { add(file, chunked); }), "/more has no checksum");
}

TEST_F(UnprotectedFile, HeadersWithoutChecksums) {
  const std::string path = place_ / "old.h5";
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  expect_refused(path, "has a header without a checksum");
}

TEST_F(UnprotectedFile, ContentInOtherFiles) {
  const std::string other = place_.write("raw.bin", std::string(80, 'x'));
  const auto external = [&](hid_t creation) { H5Pset_external(creation, other.c_str(), 0, 80); };
  expect_refused(made([&](hid_t file) { add(file, external); }), "/more is stored in another file");
  const auto link = [](hid_t file) {
    H5Lcreate_external("other.h5", "/numbers", file, "linked", H5P_DEFAULT, H5P_DEFAULT);
  };
  expect_refused(made(link), "/linked is a link to another file");
  const auto symbolic = [](hid_t file) {
    H5Lcreate_soft("/group/numbers", file, "again", H5P_DEFAULT, H5P_DEFAULT);
  };
  expect_refused(made(symbolic), "/again is a symbolic link");
}

TEST_F(UnprotectedFile, DatasetsMadeOfOthers) {
  const auto of_others = [](hid_t creation) {
    const hsize_t count = 10;
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    H5Pset_virtual(creation, space, "other.h5", "/numbers", space);
    H5Sclose(space);
  };
  const auto add_virtual = [&](hid_t file) {
    const hsize_t count = 10;
    const hid_t space = H5Screate_simple(1, &count, nullptr), creation = H5Pcreate(H5P_DATASET_CREATE);
    of_others(creation);
    const hid_t data = H5Dcreate2(file, "more", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Dclose(data), H5Pclose(creation), H5Sclose(space);
  };
  expect_refused(made(add_virtual), "/more is made of other datasets");
}

}  // namespace
}  // namespace cleft
