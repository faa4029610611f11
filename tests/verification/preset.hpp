#pragma once

namespace surge {

/// A method and one of its presets, as tests of several presets name them.
struct MethodPreset {
  const char* method;
  const char* name;
};

}  // namespace surge
