/**
 * @file overloaded.hpp
 * One visitor of several functions, for std::visit.
 */
#pragma once

namespace elvis {

template <class... Functions> struct Overloaded : Functions... { using Functions::operator()...; };
template <class... Functions> Overloaded(Functions...) -> Overloaded<Functions...>;

} // namespace elvis
