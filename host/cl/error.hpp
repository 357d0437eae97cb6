/// Errors of the compute layer. Every message says what was being done, on which device or kernel,
/// what OpenCL answered (by name) and what to do about it.
#pragma once

#include <stdexcept>
#include <string>

namespace macula::compute {

/// Name of an OpenCL status, e.g. "CL_OUT_OF_RESOURCES"; "CL error -9999" for an unknown one.
std::string status_name(int status);

/// What a user can do about an OpenCL status; empty when there is nothing general to say.
std::string status_advice(int status);

class Error : public std::runtime_error {
  public:
    /// For errors found before OpenCL was asked.
    explicit Error(const std::string& message) : std::runtime_error(message) {}
    /// "<doing>: <status name> (<advice>)".
    Error(const std::string& doing, int status);

    /// The OpenCL status, 0 when the error was found before OpenCL was asked.
    int status() const { return status_; }

  private:
    int status_ = 0;
};

/// A program that the device's compiler refused. The log names kernel files and lines.
class BuildError : public Error {
  public:
    BuildError(const std::string& what, const std::string& device, std::string log, int status);

    const std::string& log() const { return log_; }

  private:
    std::string log_;
};

} // namespace macula::compute
