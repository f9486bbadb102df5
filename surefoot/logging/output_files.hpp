#pragma once

#include <filesystem>
#include <string>

namespace surefoot::logging {

/// Throws FileError, with the reason, if a file can't be written at this path. Leaves no file.
void check_writable_file(const std::filesystem::path& file);

/// Throws FileError, naming the process, while another run records to this log.
void check_not_being_written(const std::filesystem::path& log);

/// Throws FileError if both are the same file: the input would be lost.
void check_not_the_input(const std::filesystem::path& output, const std::filesystem::path& input);

/// Makes the folder if there is none. Throws FileError, with the reason, if files could not be
/// written into it.
void prepare_folder(const std::filesystem::path& folder);

/// Removes the page of a report folder, and its log with the unfinished one, so that no files of an
/// earlier run stay there. `log` may be empty. Throws FileError, also if another run records to it.
void remove_outdated(const std::filesystem::path& report_folder, const std::filesystem::path& log);

/// Removes the folder if nothing is in it.
void remove_if_empty(const std::filesystem::path& folder);

/// "run.mcap" → "run-2.mcap", or the next number without a log, finished or not.
[[nodiscard]] std::filesystem::path next_free_log(const std::filesystem::path& log);

/// Writes a file whole (WholeFile). Throws FileError.
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace surefoot::logging
