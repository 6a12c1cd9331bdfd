// SPDX-License-Identifier: MIT
// How the readers of scene files give up on bad input: they throw inside, and their entry points return an
// Error.
#pragma once

#include "rebound/result.hpp"

#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <utility>

namespace rebound::lab {

class InputError : public std::exception {
public:
    explicit InputError(Error error) : error_(std::move(error)) {}
    const char* what() const noexcept override { return error_.message.c_str(); }
    const Error& error() const { return error_; }

private:
    Error error_;
};

// The message needs no file name: guardInput puts it in front.
[[noreturn]] inline void refuse(std::string message, ErrorCode code = ErrorCode::invalidData) {
    throw InputError(Error{code, std::move(message)});
}

// Names in files may hold anything; an error is one line of bearable length.
inline std::string oneLine(std::string text) {
    constexpr size_t longest = 600;
    if (text.size() > longest) text = text.substr(0, longest) + "...";
    while (!text.empty() && (text.back() == '\n' || text.back() == '.' || text.back() == ' '))
        text.pop_back();
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    return text;
}

// Runs a reader, and turns whatever it throws into an Error that begins with the file's name.
template <class Read>
auto guardInput(const std::filesystem::path& file, Read&& read) -> Result<decltype(read())> {
    std::string prefix("'");
    prefix.append(file.string()).append("': ");
    try {
        return read();
    } catch (const InputError& failure) {
        return Error{failure.error().code, prefix + oneLine(failure.error().message)};
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, prefix + "there is not enough memory to read it"};
    } catch (const std::exception&) {
        // A library's words would name things that the file's author has never heard of.
        return Error{ErrorCode::invalidData, prefix + "it holds something that cannot be read"};
    }
}

} // namespace rebound::lab
