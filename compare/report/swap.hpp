#pragma once

#include <filesystem>
#include <functional>

namespace surge::compare {

/// Makes the folder of a report whole or not at all: `make` fills a folder beside it, which then
/// takes its place in one step. Until then, and if `make` throws or the process is killed, an older
/// report stays as it is. What killed processes left of their folders is removed. Throws
/// surge::Error, with the reason, where the folder is a link, holds other things than a report, or
/// cannot be made.
void make_in_place(const std::filesystem::path& folder,
                   const std::function<void(const std::filesystem::path& unfinished)>& make);

}  // namespace surge::compare
