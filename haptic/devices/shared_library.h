// A driver's library, loaded when its device is requested, so that not all drivers must be installed. It
// remains loaded, because drivers keep memory and threads that need its code.
#pragma once

#include <dlfcn.h>

#include <string>

#include "base/error.h"

namespace cleft {

class SharedLibrary {
 public:
  /// Throws InputError: "<device>: <library> cannot be loaded (...): <remedy>".
  SharedLibrary(const std::string& device, const std::string& library, const std::string& remedy)
      : device_(device),
        library_(library),
        handle_(dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
    if (!handle_) {
      const char* reason = dlerror();
      throw InputError(device + ": " + library + " cannot be loaded (" +
                       (reason ? reason : "no reason given") + "): " + remedy);
    }
  }
  ~SharedLibrary() { dlclose(handle_); }
  SharedLibrary(const SharedLibrary&) = delete;
  SharedLibrary& operator=(const SharedLibrary&) = delete;

  /// Fills a pointer to a function; throws InputError if the library has none of that name.
  template <class Function>
  void find(Function*& function, const char* name) const {
    function = reinterpret_cast<Function*>(dlsym(handle_, name));
    if (!function)
      throw InputError(device_ + ": " + library_ + " has no function " + name +
                       "; it is too old, or another library");
  }

 private:
  std::string device_, library_;
  void* handle_;
};

}  // namespace cleft
