/**
 * @file request_records.hpp
 * The record buffers of a kernel's request and where they are bound.
 */
#pragma once

#include <core/shader/composer.hpp>

#include <cstdint>
#include <vector>

namespace elvis {

/** The record buffers of a request, each once, numbered as they are met. */
class RequestRecords {
public:
    explicit RequestRecords(const KernelRequest& request);

    const std::vector<const RecordBuffer*>& all() const { return m_records; }
    std::uint32_t number(const RecordBuffer* records) const;
    /** Descriptors of all parts of all buffers, behind the kernel's own bindings. */
    std::vector<BoundBuffer> bindings() const;
    /** Behind these. */
    std::uint32_t watch_binding() const { return m_first_binding + static_cast<std::uint32_t>(bindings().size()); }

private:
    void add(const RecordBuffer* records);
    void add_all(const std::vector<FetchBuffer>& buffers);

    std::uint32_t m_first_binding;
    std::vector<const RecordBuffer*> m_records;
};

} // namespace elvis
