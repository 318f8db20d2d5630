#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "base/check.h"

namespace telestrain {

// Why an operation failed, as the exit code that the program ends with.
enum class ErrorKind {
  kUsage = 2,             // the command line asks for something that does not exist
  kBadInput = 3,          // a file or value handed to us is missing, malformed or out of range
  kEstimationFailed = 4,  // the data are readable but do not determine the result
  kOutputFailed = 5,      // rendering, the report or a write failed
};

// An expected failure. `message` says what was wanted, what was found, the limit and the remedy.
struct Error {
  ErrorKind kind = ErrorKind::kBadInput;
  std::string message;
};

inline Error BadInput(std::string message) { return {ErrorKind::kBadInput, std::move(message)}; }
inline Error EstimationFailed(std::string message) {
  return {ErrorKind::kEstimationFailed, std::move(message)};
}
inline Error OutputFailed(std::string message) {
  return {ErrorKind::kOutputFailed, std::move(message)};
}

// Either a value or an Error. Reading the value of a failed result is a broken contract.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}      // NOLINT
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  const T& value() const& {
    RequireOk();
    return std::get<0>(content_);
  }
  T& value() & {
    RequireOk();
    return std::get<0>(content_);
  }
  T&& value() && {
    RequireOk();
    return std::get<0>(std::move(content_));
  }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

  const Error& error() const {
    TELESTRAIN_CHECK(!ok(), "error() of a result that holds a value");
    return std::get<1>(content_);
  }

 private:
  void RequireOk() const {
    TELESTRAIN_CHECK(ok(), "value() of a failed result: " + std::get<1>(content_).message);
  }
  std::variant<T, Error> content_;
};

// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT

  bool ok() const { return !error_.has_value(); }
  explicit operator bool() const { return ok(); }
  const Error& error() const {
    TELESTRAIN_CHECK(!ok(), "error() of a result that succeeded");
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

using Status = Result<void>;

}  // namespace telestrain

// Evaluates an expression that yields a Result and leaves the function with its error, if any.
#define TELESTRAIN_RETURN_IF_ERROR(expression)                         \
  do {                                                                 \
    if (auto status_ = (expression); !status_) return status_.error(); \
  } while (false)

#define TELESTRAIN_CONCAT_INNER(a, b) a##b
#define TELESTRAIN_CONCAT(a, b) TELESTRAIN_CONCAT_INNER(a, b)

// `TELESTRAIN_ASSIGN_OR_RETURN(const auto text, ReadFile(path));`
#define TELESTRAIN_ASSIGN_OR_RETURN(declaration, expression)                                      \
  auto TELESTRAIN_CONCAT(result_, __LINE__) = (expression);                                       \
  if (!TELESTRAIN_CONCAT(result_, __LINE__)) return TELESTRAIN_CONCAT(result_, __LINE__).error(); \
  declaration = std::move(TELESTRAIN_CONCAT(result_, __LINE__)).value()  // NOLINT: a declaration
