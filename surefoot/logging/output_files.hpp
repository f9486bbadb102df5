#pragma once

#include <filesystem>
#include <string>

namespace surefoot::logging {

/// Throws FileError, with the reason, if a file could not be written at this path. Leaves nothing
/// behind.
void check_writable_file(const std::filesystem::path& file);

/// Throws FileError, naming the process, while another run records to this log.
void check_not_being_written(const std::filesystem::path& log);

/// Throws FileError if both are the same file: the input would be lost.
void check_not_the_input(const std::filesystem::path& output, const std::filesystem::path& input);

/// Makes the folder if there is none. Throws FileError, with the reason, if files could not be
/// written into it.
void prepare_folder(const std::filesystem::path& folder);

/// Removes the page of a report folder, and a log with what a crash left of it, so that an earlier
/// run's never lie beside what the next one leaves. A log without a name stays. Throws FileError,
/// also where another run records to the log.
void remove_outdated(const std::filesystem::path& report_folder, const std::filesystem::path& log);

/// Removes the folder if nothing is in it.
void remove_if_empty(const std::filesystem::path& folder);

/// "run.mcap" → "run-2.mcap", or the next number of which there is neither a log nor one that was
/// cut off.
[[nodiscard]] std::filesystem::path next_free_log(const std::filesystem::path& log);

/// Writes a file whole (WholeFile). Throws FileError.
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace surefoot::logging
