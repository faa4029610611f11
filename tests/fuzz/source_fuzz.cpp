#include "compare/read/readers.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// Whole sources: a folder of files, opened as a user would, and all of its frames.
namespace {

/// A relative name without a way up.
bool is_plain(const std::string& name) {
  return !name.empty() && name.size() < 100 && name.front() != '/' &&
         name.find("..") == std::string::npos && name.find('\0') == std::string::npos;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const auto folder = fuzz::scratch().path() / "source";
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  std::filesystem::create_directories(folder);
  fuzz::each_file(text, [&](const std::string& name, std::string_view content) {
    if (!is_plain(name)) return;
    std::filesystem::create_directories((folder / name).parent_path(), ignored);
    if (!ignored) fuzz::scratch().put("source/" + name, content);
  });
  compare::SourceOptions options;
  if (!std::filesystem::exists(folder / "manifest.json") &&
      !std::filesystem::exists(folder / "system")) {
    options.spacing = compare::Metres(0.05);
    options.gravity = 9.81;
  }
  fuzz::try_reading([&] {
    compare::Run run = compare::open_run(folder, options);
    for (std::size_t k = 0; k < run.frames->times().size(); ++k)
      (void)run.frames->read(k, {.pressure = true, .velocity = true});
  });
  return 0;
}
