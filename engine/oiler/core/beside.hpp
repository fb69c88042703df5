// SPDX-License-Identifier: MIT
#pragma once

#include <future>
#include <memory>
#include <system_error>
#include <thread>

namespace oiler {

/// Calls f() on a thread, or at once if the machine gives none. (There, the std::async of libc++
/// waits for ever.) `thread` holds what f uses until it has ended.
template <class F>
[[nodiscard]] std::future<std::invoke_result_t<F>> call_beside(std::jthread& thread, F f) {
    const auto task = std::make_shared<std::packaged_task<std::invoke_result_t<F>()>>(std::move(f));
    std::future<std::invoke_result_t<F>> result = task->get_future();
    try {
        thread = std::jthread([task] { (*task)(); });
    } catch (const std::system_error&) {
        (*task)();
    }
    return result;
}

}  // namespace oiler
