/**
 * @file describe.hpp
 * What is on the screen, for tests that cannot see.
 */
#pragma once

#include "ui.hpp"

#include <string>

namespace elvis::view {

/** As JSON. */
std::string description(Ui& ui);

} // namespace elvis::view
