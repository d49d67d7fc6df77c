// Result<T>: a value, or an error that says what is wrong where and what to do about it.
// Used for everything that comes from outside (files, presets, command line, GL limits). A bug in our own code is
// not a value: it stops the program through FB_CHECK (check.h).
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace fb {

struct Error {
    enum class Kind { failed, usage };  // exit code 1 and 2

    Kind kind = Kind::failed;
    std::string file;    // the file or option concerned; may be empty
    std::string place;   // where in it: "line 12", "byte 400", "node 7"; may be empty
    std::string reason;  // what is wrong
    std::string hint;    // what to do; may be empty

    // "FILE: PLACE: REASON (HINT)": one line, whatever the parts contain.
    [[nodiscard]] std::string oneLine() const;
};

template <class T>
using Result = tl::expected<T, Error>;

// An error to be returned from a function that returns Result<T>.
[[nodiscard]] inline tl::unexpected<Error> failure(std::string file, std::string place, std::string reason,
                                                   std::string hint = {}) {
    return tl::make_unexpected(
        Error{Error::Kind::failed, std::move(file), std::move(place), std::move(reason), std::move(hint)});
}

[[nodiscard]] inline tl::unexpected<Error> usageFailure(std::string option, std::string reason,
                                                        std::string hint = {}) {
    return tl::make_unexpected(
        Error{Error::Kind::usage, std::move(option), {}, std::move(reason), std::move(hint)});
}

// Passes on the error of another result.
template <class T>
[[nodiscard]] tl::unexpected<Error> passOn(Result<T>& result) {
    return tl::make_unexpected(std::move(result.error()));
}

}  // namespace fb
