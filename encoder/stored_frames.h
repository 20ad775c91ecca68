// Values at the nodes, frame by frame, in memory or in a temporary file.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace cleft {

/// A temporary file without a name, which ends with the process. Its pages are read when they are used, and
/// the system takes them back when memory is short.
class SpillFile {
 public:
  /// In `folder`. Throws InputError if no file can be made there.
  explicit SpillFile(const std::string& folder);
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  const std::string& folder() const { return folder_; }
  /// Room for so many numbers, for as long as the file lives. Throws std::runtime_error if the disk is full.
  double* room(std::size_t numbers);
  /// Takes pages back; they are read again when they are used.
  static void forget(const double* numbers, std::size_t count);

 private:
  std::string folder_;
  int file_;
  std::size_t size_ = 0;
  std::vector<std::pair<void*, std::size_t>> maps_;
};

/// Matrices of N rows and `Columns` columns, one a frame, which never change. Copies share them.
template <int Columns>
class StoredFrames {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Columns>;
  using View = Eigen::Map<const Matrix>;

  StoredFrames() = default;  ///< in memory
  explicit StoredFrames(std::shared_ptr<SpillFile> file) : file_(std::move(file)) {}

  std::size_t size() const { return frames_.size(); }
  bool empty() const { return frames_.empty(); }
  View operator[](std::size_t frame) const {
    const Frame& f = frames_[frame];
    return {f.numbers.get(), f.rows, f.columns};
  }
  View front() const { return (*this)[0]; }
  View back() const { return (*this)[size() - 1]; }
  /// None yet, and in a file of their own where these are in one.
  StoredFrames like_these() const {
    return file_ ? StoredFrames(std::make_shared<SpillFile>(file_->folder())) : StoredFrames();
  }

  void clear() { frames_.clear(); }
  void push_back(const Matrix& matrix) { frames_.push_back(stored(matrix)); }
  /// The same matrix in so many frames, stored once.
  void assign(std::size_t frames, const Matrix& matrix) { frames_.assign(frames, stored(matrix)); }

  /// What was read of a frame in a file need not stay in memory.
  void forget(std::size_t frame) const {
    const Frame& f = frames_[frame];
    if (file_) SpillFile::forget(f.numbers.get(), static_cast<std::size_t>(f.rows * f.columns));
  }

  class Iterator {
   public:
    Iterator(const StoredFrames& frames, std::size_t at) : frames_(frames), at_(at) {}
    View operator*() const { return frames_[at_]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    const StoredFrames& frames_;
    std::size_t at_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  struct Frame {
    std::shared_ptr<const double> numbers;
    Eigen::Index rows = 0, columns = 0;
  };

  Frame stored(const Matrix& matrix) const {
    const auto count = static_cast<std::size_t>(matrix.size());
    std::shared_ptr<double> numbers;
    if (file_)
      numbers = {file_, file_->room(count)};  // lives as long as the file
    else
      numbers = {new double[count], std::default_delete<double[]>()};
    Eigen::Map<Matrix>(numbers.get(), matrix.rows(), matrix.cols()) = matrix;
    if (file_) SpillFile::forget(numbers.get(), count);
    return {std::move(numbers), matrix.rows(), matrix.cols()};
  }

  std::shared_ptr<SpillFile> file_;
  std::vector<Frame> frames_;
};

}  // namespace cleft
