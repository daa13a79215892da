/**
 * @file removal_of_temporary.hpp
 * What a conversion by many processes leaves behind when they are ended: nothing.
 */
#pragma once

#include <core/base/team.hpp>

#include <string>
#include <thread>

namespace elvis::commands {

/**
 * While it lives, a polite kill removes the file that the team's first process writes before it has its name, and ends this
 * process. All members do so: when one of them is killed, its launcher ends the others in this way.
 */
class RemovalOfTemporary {
public:
    /** Called by all. */
    RemovalOfTemporary(const std::string& output, Team& team);
    ~RemovalOfTemporary();
    RemovalOfTemporary(const RemovalOfTemporary&) = delete;
    RemovalOfTemporary& operator=(const RemovalOfTemporary&) = delete;

private:
    void (*m_previous)(int);
    std::jthread m_watcher;
};

} // namespace elvis::commands
