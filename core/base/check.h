// FB_CHECK(a == b): stops the program on a bug of ours, printing both sides and what was being worked on.
// It is for invariants only. Input from outside is answered with Result (result.h).
#pragma once

#include <sstream>
#include <string>

namespace fb::detail {

[[noreturn]] void checkFailed(const char* expression, const std::string& sides, const char* file, int line);

// Captures the left side of a comparison so that both sides can be printed: Capture{} <=> a == b. The
// operator binds tighter than the comparisons and looser than sums and products, and no compiler asks for
// parentheses around it.
template <class L>
struct Left {
    const L& left;

    template <class R>
    std::string sides(const R& right) const {
        std::ostringstream text;
        text << left << " against " << right;
        return text.str();
    }
};

struct Verdict {
    bool holds;
    std::string sides;
};

#define FB_CHECK_OPERATOR(op)                               \
    template <class L, class R>                             \
    Verdict operator op(const Left<L>& l, const R& right) { \
        if (l.left op right) return {true, {}};             \
        return {false, l.sides(right)};                     \
    }
FB_CHECK_OPERATOR(==)
FB_CHECK_OPERATOR(!=)
FB_CHECK_OPERATOR(<)
FB_CHECK_OPERATOR(<=)
FB_CHECK_OPERATOR(>)
FB_CHECK_OPERATOR(>=)
#undef FB_CHECK_OPERATOR

struct Capture {
    template <class L>
    Left<L> operator<=>(const L& left) const {
        return {left};
    }
};

template <class L>
Verdict verdict(const Left<L>& l) {
    return {static_cast<bool>(l.left), "false"};
}
inline Verdict verdict(Verdict v) {
    return v;
}

}  // namespace fb::detail

#define FB_CHECK(...)                                                                                       \
    do {                                                                                                    \
        auto fbVerdict = ::fb::detail::verdict(::fb::detail::Capture{} <=> __VA_ARGS__);                    \
        if (!fbVerdict.holds) ::fb::detail::checkFailed(#__VA_ARGS__, fbVerdict.sides, __FILE__, __LINE__); \
    } while (false)
