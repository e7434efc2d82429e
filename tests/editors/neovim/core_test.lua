-- The server through Neovim's own client, by what a user presses or sees: a line for each check, and a count.
-- usage: SDLC=… nvim --headless --clean -n -c 'luafile core_test.lua', in an empty folder
local PATIENCE_MS = 20000
local CAMERA = 'camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }'
local BALL = 'sphere ball { center: (0, 0, 0), radius: 1, material: diffuse(color: tan) }'

local folder = vim.fn.getcwd()
local passed, failed = 0, 0

local function check(name, run)
  local ok, message = xpcall(run, debug.traceback)
  if ok then passed = passed + 1 else failed = failed + 1 end
  io.stdout:write((ok and 'ok    ' or 'FAIL  ') .. name .. '\n' .. (ok and '' or message .. '\n'))
end

local function write(name, lines)
  vim.fn.writefile(lines, folder .. '/' .. name)
end

local client = vim.lsp.start_client({
  name = 'sdlc',
  cmd = { os.getenv('SDLC'), 'lsp' },
  root_dir = folder,
})

--- Opens a file with these lines in a window of its own; the server knows it.
local function open(name, lines)
  write(name, lines)
  vim.cmd('silent! %bwipeout!')
  vim.cmd('edit ' .. folder .. '/' .. name)
  vim.bo.filetype = 'scene'
  vim.lsp.buf_attach_client(0, client)
  return vim.api.nvim_get_current_buf()
end

local function until_true(what, condition)
  assert(vim.wait(PATIENCE_MS, condition, 20), 'never happened: ' .. what)
end

local function cursor(line, column)
  vim.api.nvim_win_set_cursor(0, { line, column - 1 })
end

local function text(buffer)
  return table.concat(vim.api.nvim_buf_get_lines(buffer or 0, 0, -1, false), '\n')
end

local function findings(count)
  until_true(count .. ' diagnostics', function() return #vim.diagnostic.get(0) == count end)
  return vim.diagnostic.get(0)
end

--- Waits until the server has answered a question about the buffer.
local function ready()
  local params = { textDocument = vim.lsp.util.make_text_document_params() }
  return vim.lsp.buf_request_sync(0, 'textDocument/documentSymbol', params, PATIENCE_MS)[client].result
end

check('diagnostics', function()
  open('a.scene', { 'scene 1', CAMERA, (BALL:gsub('radius', 'radus')) })
  local found = findings(1)[1]
  assert(found.lnum == 2 and found.col == 33 and found.end_col == 38, vim.inspect(found))
  assert(found.message:find('unknown property `radus`', 1, true), found.message)
  assert(found.severity == vim.diagnostic.severity.ERROR and found.source == 'sdlc')
end)

check('diagnostics while typing', function()
  open('typing.scene', { 'scene 1', CAMERA, BALL })
  vim.api.nvim_buf_set_lines(0, 3, 3, false, { 'let a = lenght((1, 2, 3))' })
  findings(1)
  vim.api.nvim_buf_set_lines(0, 3, 4, false, {})
  findings(0)
end)

check('fixes', function()
  open('fix.scene', { 'scene 1', CAMERA, (BALL:gsub('radius', 'radus')) })
  findings(1)
  cursor(3, 35)
  vim.ui.select = function(items, _, choose)
    for _, item in ipairs(items) do
      local action = item[2] or item
      if action.title:find('radius', 1, true) then return choose(item) end
    end
    choose(nil)
  end
  vim.lsp.buf.code_action()
  until_true('the fix', function() return text() == table.concat({ 'scene 1', CAMERA, BALL }, '\n') end)
end)

check('completion', function()
  open('complete.scene', { 'scene 1', CAMERA, 'sphere { ra }' })
  ready()
  cursor(3, 12)
  local params = vim.lsp.util.make_position_params()
  params.position = { line = 2, character = 11 }
  local result = vim.lsp.buf_request_sync(0, 'textDocument/completion', params, PATIENCE_MS)[client].result
  local items = vim.lsp.util.text_document_completion_list_to_complete_items(result, 'ra')
  local labels = vim.tbl_map(function(item) return item.abbr end, items)
  assert(vim.tbl_contains(labels, 'radius'), vim.inspect(labels))
end)

check('hover', function()
  open('hover.scene', { 'scene 1', 'let a = 2 * pi' })
  ready()
  cursor(2, 5)
  local windows = #vim.api.nvim_list_wins()
  vim.lsp.buf.hover()
  until_true('a window', function() return #vim.api.nvim_list_wins() > windows end)
  local shown
  for _, window in ipairs(vim.api.nvim_list_wins()) do
    if vim.api.nvim_win_get_config(window).relative ~= '' then shown = text(vim.api.nvim_win_get_buf(window)) end
  end
  assert(shown:find('6.283', 1, true), shown)
end)

check('signature', function()
  open('signature.scene', { 'scene 1', 'let a = clamp(1, 2, 3)' })
  ready()
  cursor(2, 18)
  local windows = #vim.api.nvim_list_wins()
  vim.lsp.buf.signature_help()
  until_true('a window', function() return #vim.api.nvim_list_wins() > windows end)
end)

local LIBRARY = { 'scene 1', 'let brass = specular(color: tan)' }
local USER = { 'scene 1', 'import "library.scene" as l', 'let a = l.brass', 'let b = l.brass' }

check('definition', function()
  write('library.scene', LIBRARY)
  open('user.scene', USER)
  ready()
  cursor(3, 12)
  vim.lsp.buf.definition()
  until_true('the other file', function() return vim.fn.expand('%:t') == 'library.scene' end)
  assert(vim.deep_equal(vim.api.nvim_win_get_cursor(0), { 2, 4 }))
end)

check('references', function()
  write('library.scene', LIBRARY)
  open('user.scene', USER)
  ready()
  cursor(3, 12)
  vim.fn.setqflist({})
  vim.lsp.buf.references({ includeDeclaration = true })
  until_true('three places', function() return #vim.fn.getqflist() == 3 end)
  vim.cmd('cclose')
end)

check('rename', function()
  write('library.scene', LIBRARY)
  local user = open('user.scene', USER)
  ready()
  cursor(3, 12)
  vim.lsp.buf.rename('gold')
  until_true('the new name', function() return text(user):find('l.gold\nlet b = l.gold', 1, true) end)
  vim.cmd('silent wall')
  local library = table.concat(vim.fn.readfile(folder .. '/library.scene'), '\n')
  assert(library == 'scene 1\nlet gold = specular(color: tan)', library)
end)

check('formatting', function()
  open('layout.scene', { 'scene 1', 'let  a=1' })
  ready()
  vim.lsp.buf.formatting_sync(nil, PATIENCE_MS)
  assert(text() == 'scene 1\nlet a = 1', text())
end)

check('symbols', function()
  open('symbols.scene', { 'scene 1', CAMERA, 'let size = 1', BALL })
  ready()
  vim.fn.setloclist(0, {})
  vim.lsp.buf.document_symbol()
  until_true('symbols', function() return #vim.fn.getqflist() + #vim.fn.getloclist(0) >= 3 end)
end)

vim.lsp.stop_client(client)
io.stdout:write(('%d of %d checks passed\n'):format(passed, passed + failed))
vim.cmd(failed > 0 and 'cquit 1' or 'qall!')
