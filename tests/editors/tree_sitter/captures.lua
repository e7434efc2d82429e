-- Prints what a query captures in files, by the parser in Neovim, as captures.mjs does.
--
--   PARSER=sdlc.so QUERY=highlights.scm FILES=a.scene:b.scene OUT=captures.txt nvim --headless --clean -l captures.lua
--
-- Neovim 0.7 has no `-l`: -c 'luafile captures.lua'.
local function read(path)
  local file = assert(io.open(path, 'rb'))
  local text = file:read('*a')
  file:close()
  return text
end

local function load_parser(path)
  if vim.treesitter.language.add then
    vim.treesitter.language.add('sdlc', { path = path })
  else
    vim.treesitter.require_language('sdlc', path)
  end
end

local function captures_of(query, text)
  local root = vim.treesitter.get_string_parser(text, 'sdlc'):parse()[1]:root()
  local captures = {}
  for id, node in query:iter_captures(root, text, 0, -1) do
    local _, _, first = node:start()
    local _, _, last = node:end_()
    table.insert(captures, { first, last, query.captures[id] })
  end
  table.sort(captures, function(a, b)
    if a[1] ~= b[1] then return a[1] < b[1] end
    if a[2] ~= b[2] then return a[2] < b[2] end
    return a[3] < b[3]
  end)
  return captures, root:has_error()
end

local function run()
  load_parser(vim.env.PARSER)
  local parse = vim.treesitter.query and vim.treesitter.query.parse or vim.treesitter.parse_query
  local query = parse('sdlc', read(vim.env.QUERY))
  local out = assert(io.open(vim.env.OUT, 'wb'))
  for _, file in ipairs(vim.split(vim.env.FILES, ':')) do
    out:write(file, '\n')
    local captures, has_error = captures_of(query, read(file))
    for _, capture in ipairs(captures) do
      out:write(table.concat(capture, ' '), '\n')
    end
    if has_error then out:write('error\n') end
  end
  out:close()
end

local is_done, message = pcall(run)
if not is_done then
  io.stderr:write(message, '\n')
  vim.cmd('cquit')
end
vim.cmd('qall!')
