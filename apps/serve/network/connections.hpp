/**
 * @file connections.hpp
 * Connections of the server: requests for the page's files, and the web sockets of sessions. One thread runs them all.
 */
#pragma once

#include "request.hpp"

#include <apps/serve/serve.hpp>
#include <apps/serve/session/sessions.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>

#include <cstddef>
#include <memory>
#include <string>

namespace elvis::serve {

/** What connections share. */
struct Hall {
    boost::asio::io_context& io;
    Sessions& sessions;
    const Options& options;
    std::string token;
    std::size_t n_connections = 0;
};

/** Counts a connection as long as it lives. */
class Counted {
public:
    explicit Counted(Hall& hall) : m_hall(&hall) { ++hall.n_connections; }
    Counted(Counted&& other) noexcept : m_hall(std::exchange(other.m_hall, nullptr)) {}
    Counted& operator=(Counted&&) = delete;
    ~Counted() {
        if (m_hall != nullptr) {
            --m_hall->n_connections;
        }
    }

private:
    Hall* m_hall;
};

using Request = boost::beast::http::request<boost::beast::http::string_body>;

/** Reads requests until the other side or a deadline ends it. */
void start_http(Hall& hall, boost::asio::ip::tcp::socket socket);
/** Of a request that may have it. */
void start_web_socket(Hall& hall, Counted counted, boost::beast::tcp_stream stream, const Request& request,
                      std::shared_ptr<Session> session, bool is_companion);

} // namespace elvis::serve
