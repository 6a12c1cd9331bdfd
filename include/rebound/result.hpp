// SPDX-License-Identifier: MIT
// How Rebound reports failure: a value or an error, never an exception and never an abort.
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace rebound {

enum class ErrorCode {
    invalidArgument, // a value outside its documented range, or arguments that contradict each other
    invalidData,     // a file or an image whose content cannot be used
    notFound,        // a file, camera, preset or kernel that does not exist
    inputOutput,     // reading or writing failed
    outOfMemory,
    unsupported, // the device cannot do what was asked of it
    deviceLost,  // the GPU has stopped answering; what was made with it can only be destroyed
};

// One sentence that names the argument, its value and what was expected.
struct Error {
    ErrorCode code = ErrorCode::invalidArgument;
    std::string message;
};

// A value of type T, or an Error. Result<> says only whether something succeeded.
template <class T = std::monostate>
class [[nodiscard]] Result {
public:
    using Value = T;

    Result() requires std::is_same_v<T, std::monostate> : state(T{}) {}
    Result(T value) : state(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state(std::in_place_index<1>, std::move(error)) {}

    explicit operator bool() const { return state.index() == 0; }

    // Precondition of these four: the result holds a value.
    T& operator*() & { return *std::get_if<0>(&state); }
    const T& operator*() const& { return *std::get_if<0>(&state); }
    T&& operator*() && { return std::move(*std::get_if<0>(&state)); }
    T* operator->() { return std::get_if<0>(&state); }
    const T* operator->() const { return std::get_if<0>(&state); }

    // Precondition: the result holds an error.
    const Error& error() const { return *std::get_if<1>(&state); }

private:
    std::variant<T, Error> state;
};

inline Error invalidArgument(std::string message) { return {ErrorCode::invalidArgument, std::move(message)}; }

} // namespace rebound
